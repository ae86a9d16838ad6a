#pragma once

namespace lcmslam {

namespace config {
class Sdf2dSlam;
}
struct Sdf2dSlamOptions;

// Fields that are set go into the options; then the options fill in what is unset. Throws CommandError (kUsage).
void BindOptions(config::Sdf2dSlam& config, Sdf2dSlamOptions& options);

}  // namespace lcmslam
