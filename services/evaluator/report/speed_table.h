#pragma once

#include "evaluator/report/study.h"
#include "evaluator/report/table.h"

namespace lcmslam::report {

// Time of a scan and of its stages over many episodes, and how fast the registration iterates. No rows where no episode
// knows.
Table SpeedTable(const Group& group);

}  // namespace lcmslam::report
