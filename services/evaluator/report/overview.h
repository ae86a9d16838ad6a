#pragma once

#include "evaluator/report/study.h"
#include "evaluator/report/table.h"

namespace lcmslam::report {

// One row for every group and system: the thesis' Tab. 4.1.
Table OverviewTable(const Study& study);
// One row for every system, one column for every group.
Table MedianTable(const Study& study);

}  // namespace lcmslam::report
