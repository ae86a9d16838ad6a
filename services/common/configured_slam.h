#pragma once

#include "bus/service.h"
#include "common/config.h"

namespace lcmslam {

// A SLAM service as RunService makes it, from
//   Shell         PlanarSlamService or SpatialSlamService;
//   SlamConfig    a Protocol Buffers message;
//   SlamOptions   members `service` (the shell's options) and `slam` (the pipeline's), both with Validate(), and kName;
// and two functions of these types, found in their namespace:
//   void BindOptions(SlamConfig&, SlamOptions&);   // see ConfigBinder
//   std::unique_ptr<...> MakeAdapter(const SlamOptions&);   // the pipeline as the shell drives it
template <class Shell, class SlamConfig, class SlamOptions>
class ConfiguredSlam : public Shell {
 public:
  using Options = SlamOptions;
  using Config = SlamConfig;
  static constexpr const char* kName = Options::kName;

  static Options Complete(Config& config) {
    Options options;
    BindOptions(config, options);
    RequireValid(options.service.Validate());
    RequireValid(options.slam.Validate());
    return options;
  }

  ConfiguredSlam(const Options& options, const Config& config, ServiceContext& context)
      : Shell(options.service, ConfigHash(ConfigText(config)), MakeAdapter(options), kName, context) {}
};

}  // namespace lcmslam
