#pragma once

#include <concepts>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/service.h"

namespace CLI {
class App;
}
namespace google::protobuf {
class Message;
}

namespace lcmslam {

// What every command line shares. Runs `body`; a CommandError ends it with its line on stderr and its code, any other
// exception with kRuntime, as does standard output that cannot be written.
int RunCommand(const std::string& name, const std::function<ExitCode()>& body);

// What the command line of every service has. With options of its own a service adds them to the same App.
struct ServiceArguments {
  RunOptions run;
  std::string config_path;
  std::vector<std::string> assignments;  // of --set
  bool print_config = false;
};
void AddServiceOptions(CLI::App& app, ServiceArguments& arguments);
// Fills an empty `config` from --config and --set.
void LoadConfig(const ServiceArguments& arguments, google::protobuf::Message& config);

// A service in terms of its parts; use RunService.
struct ServiceParts {
  std::string name;  // "sdf2d-slam"
  std::string description;
  google::protobuf::Message* config;  // empty at first; the effective configuration after `complete`
  std::function<void()> complete;     // checks the configuration and fills in what is unset
  ServiceFactory make;
};
int RunServiceParts(int argc, char** argv, const ServiceParts& parts);
// Writes the effective configuration to OUT/NAME.pbtxt; nothing when `out` is "".
void WriteEffectiveConfig(const std::filesystem::path& out, const std::string& name,
                          const google::protobuf::Message& config);
// Live or log to log, as the options say; writes the effective configuration, prints the summary.
ExitCode RunOnBus(const RunOptions& options, const ServiceParts& parts);

// The whole main of a service. S is a Service (SLAM systems: see ConfiguredSlam) with
//   using Options = ...;  using Config = a Protocol Buffers message;
//   static constexpr const char* kName;
//   static Options Complete(Config&);             // binds, validates; throws CommandError
//   S(const Options&, const Config&, ServiceContext&);
template <std::derived_from<Service> S>
int RunService(int argc, char** argv, const std::string& description) {
  typename S::Config config;
  typename S::Options options;
  return RunServiceParts(argc, argv,
                         {S::kName, description, &config, [&] { options = S::Complete(config); },
                          [&](ServiceContext& context) { return std::make_unique<S>(options, config, context); }});
}

}  // namespace lcmslam
