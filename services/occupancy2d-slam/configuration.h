#pragma once

namespace lcmslam {

namespace config {
class Occupancy2dSlam;
}
struct Occupancy2dSlamOptions;

// Fields that are set go into the options; then the options fill in what is unset. Throws CommandError (kUsage).
void BindOptions(config::Occupancy2dSlam& config, Occupancy2dSlamOptions& options);

}  // namespace lcmslam
