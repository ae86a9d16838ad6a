#pragma once

namespace lcmslam {

namespace config {
class Octo3dSlam;
}
struct Octo3dSlamOptions;

// Fields that are set go into the options; then the options fill in what is unset. Throws CommandError (kUsage).
void BindOptions(config::Octo3dSlam& config, Octo3dSlamOptions& options);

}  // namespace lcmslam
