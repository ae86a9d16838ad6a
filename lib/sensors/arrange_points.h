#pragma once

#include <span>
#include <vector>

#include "lidar/multi_line_model.h"
#include "lidar/sweep.h"

namespace lcmslam {

// What files of points leave open on the way to a Sweep. Pure.

// Takes out what is no return: coordinates that are not finite, or all zero as several drivers write them.
void DropNoReturns(std::vector<SweepPoint>& points);

// Gives points without a ring that of the laser whose elevation is nearest. Those between two lasers or beyond the
// outer ones by more than half the lasers' mean spacing stay unknown, as do all that moved since they were measured.
void SetRingsByElevation(const MultiLineModel& model, std::span<SweepPoint> points);

// Brings points into the order in which they were measured; files often hold them laser by laser. Equal times keep
// their order.
void SortByTime(std::span<SweepPoint> points);

}  // namespace lcmslam
