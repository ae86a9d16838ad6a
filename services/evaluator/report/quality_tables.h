#pragma once

#include "evaluator/report/study.h"
#include "evaluator/report/table.h"

namespace lcmslam::report {

// Relative errors over each step, drift and KITTI segments: of each system the median over episodes of their means.
Table MotionTable(const Group& group);

// What `evaluator map` said of the maps, median over episodes; no rows where it said nothing.
Table MapTable(const Group& group);

}  // namespace lcmslam::report
