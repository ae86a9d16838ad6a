#pragma once

namespace lcmslam {

namespace config {
class Cloud3dSlam;
}
struct Cloud3dSlamOptions;

// Fields that are set go into the options; then the options fill in what is unset. Throws CommandError (kUsage).
void BindOptions(config::Cloud3dSlam& config, Cloud3dSlamOptions& options);

}  // namespace lcmslam
