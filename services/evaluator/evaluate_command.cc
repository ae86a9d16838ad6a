#include "evaluator/evaluate_command.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/config.h"
#include "evaluator/evaluator.pb.h"
#include "evaluator/evaluator_service.h"
#include "evaluator/evo_archive.h"
#include "evaluator/files.h"
#include "evaluator/result.h"
#include "evaluator/table.h"

namespace lcmslam {
namespace {

void RequireUsage(bool condition, const char* line) {
  if (!condition) throw CommandError(ExitCode::kUsage, line);
}

// Flags that stand for one number of the configuration.
void AddNumber(CLI::App& app, const char* flag, const char* help, std::function<void(double)> set) {
  app.add_option_function<double>(flag, std::move(set), help);
}

void AddThresholdOptions(CLI::App& app, config::Evaluator::Thresholds& t) {
  AddNumber(app, "--max-mean", "m: exit with 5 when the mean error is larger", [&](double v) { t.set_max_mean_m(v); });
  AddNumber(app, "--max-rmse", "m: the same for the RMSE", [&](double v) { t.set_max_rmse_m(v); });
  AddNumber(app, "--max-p95", "m: the same for the 95th percentile", [&](double v) { t.set_max_p95_m(v); });
  AddNumber(app, "--max-error", "m: the same for the largest error", [&](double v) { t.set_max_error_m(v); });
  AddNumber(app, "--max-rotation", "rad: the same for the mean rotation error",
            [&](double v) { t.set_max_mean_rotation_rad(v); });
  AddNumber(app, "--min-coverage", "0 to 1: exit with 5 when less is matched",
            [&](double v) { t.set_min_coverage(v); });
}

// "se2" -> SE2.
config::Evaluator::Align AlignOf(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(c));
  config::Evaluator::Align align = config::Evaluator::AUTO;
  config::Evaluator::Align_Parse(name, &align);
  return align;
}

bool IsOnBus(const EvaluateArguments& arguments) {
  if (!arguments.service.run.log_in.empty()) return !arguments.service.run.log_out.empty();
  return arguments.estimate.empty() || !NamesFile(arguments.estimate);
}

// Judges by the thresholds, prints, writes. `json` may be empty.
ExitCode Report(result::Evaluation& message, const EvaluatorOptions& options, const std::filesystem::path& json) {
  const bool met = AddThresholds(options.thresholds, message);
  fmt::print("{}", FormatTable(message));
  if (!json.empty()) WriteFile(json, ToJson(message));
  return met ? ExitCode::kOk : ExitCode::kThresholdMissed;
}

bool WantsReference(const EvaluateArguments& arguments) {
  return arguments.relations.empty() || !arguments.reference.empty();
}

PoseSources ReadSources(const EvaluateArguments& arguments, const EvaluatorOptions& options) {
  const auto& log = arguments.service.run.log_in;
  const bool needs_reference = WantsReference(arguments);
  if (log.empty()) {
    RequireUsage(!needs_reference || NamesFile(arguments.reference), "--reference FILE or --relations FILE: required");
    if (!needs_reference) return {ReadPoseFile(arguments.estimate, arguments.read), {}};
    return ReadPoseFiles(arguments.estimate, arguments.reference, arguments.read);
  }
  const bool estimate_is_file = NamesFile(arguments.estimate), reference_is_file = NamesFile(arguments.reference);
  const auto channel = [](bool is_needed, const std::string& given, const std::string& configured) {
    return !is_needed ? "" : given.empty() ? configured : given;
  };
  PoseSources sources =
      ReadPoseChannels(log, channel(!estimate_is_file, arguments.estimate, options.estimate_channel),
                       channel(needs_reference && !reference_is_file, arguments.reference, options.reference_channel),
                       arguments.service.run.quiet);
  if (estimate_is_file) sources.estimate = ReadPoseFile(arguments.estimate, arguments.read);
  if (needs_reference && reference_is_file) sources.reference = ReadPoseFile(arguments.reference, arguments.read);
  return sources;
}

std::string Span(const PoseSource& source) {
  return fmt::format("{} ({:.3f} to {:.3f} s)", source.name,
                     static_cast<double>(source.trajectory.front().utime) * 1e-6,
                     static_cast<double>(source.trajectory.back().utime) * 1e-6);
}

// Takes the trajectories out of the sources, which may be large.
Evaluation EvaluateSources(PoseSources& sources, const EvaluationOptions& options) {
  const std::string estimate_span = Span(sources.estimate), reference_span = Span(sources.reference);
  Evaluation evaluation =
      Evaluate(std::move(sources.estimate.trajectory), std::move(sources.reference.trajectory), options);
  if (evaluation.status == EvaluationStatus::kNothingMatched) {
    throw CommandError(ExitCode::kNothingMatched,
                       fmt::format("no pose of {} has a partner in {}", estimate_span, reference_span));
  }
  if (evaluation.status == EvaluationStatus::kCalibrationFailed) {
    const bool too_few = evaluation.calibration->status == CalibrationStatus::kTooFewPairs;
    throw CommandError(ExitCode::kBadInput,
                       fmt::format("calibration of {} by {}: {}", sources.estimate.name, sources.reference.name,
                                   too_few ? "too few matched poses" : "does not converge"));
  }
  return evaluation;
}

RelationErrors EvaluateRelationFile(const PoseSource& estimate, const std::filesystem::path& path,
                                    const EvaluationOptions& options, result::Evaluation::Source& source) {
  const std::vector<Relation> relations = ReadRelationFile(path);
  source.set_name(path.string());
  source.set_poses(static_cast<int32_t>(relations.size()));
  RelationErrors errors = EvaluateRelations(estimate.trajectory, relations, options.association.max_gap_us);
  if (errors.errors.translation_m.empty()) {
    throw CommandError(ExitCode::kNothingMatched,
                       fmt::format("no relation of {} lies within {}", path.string(), Span(estimate)));
  }
  return errors;
}

ExitCode EvaluateRecording(const EvaluateArguments& arguments, const EvaluatorOptions& options) {
  RequireUsage(arguments.evo_zip.empty() || WantsReference(arguments), "--evo-zip: needs --reference");
  PoseSources sources = ReadSources(arguments, options);
  result::Evaluation message;
  message.set_command(arguments.command);
  AddSource(sources.estimate, *message.mutable_estimate());
  if (!arguments.relations.empty()) {
    AddRelations(EvaluateRelationFile(sources.estimate, arguments.relations, options.evaluation,
                                      *message.mutable_relation_file()),
                 message);
  }
  if (!sources.reference.trajectory.empty()) {
    AddSource(sources.reference, *message.mutable_reference());
    const Evaluation evaluation = EvaluateSources(sources, options.evaluation);
    AddEvaluation(evaluation, options.evaluation, message);
    if (!arguments.evo_zip.empty()) WriteEvoArchive(evaluation, message, arguments.evo_zip);
  }
  if (result::Timing timing; sources.timing.Report(sources.estimate.channel, timing)) {
    *message.mutable_timing() = std::move(timing);
  }
  const ExitCode code = Report(message, options, arguments.json);
  if (!sources.log_damage.empty()) throw CommandError(ExitCode::kBadInput, sources.log_damage);
  return code;
}

// run.json -> run_SDF2D_POSE.json when there are several.
std::filesystem::path JsonPath(const std::filesystem::path& json, const std::string& channel, bool is_only_one) {
  if (json.empty() || is_only_one) return json;
  return json.parent_path() / fmt::format("{}_{}{}", json.stem().string(), channel, json.extension().string());
}

ExitCode EvaluateOnBus(const EvaluateArguments& arguments, EvaluatorOptions options, config::Evaluator& config) {
  RequireUsage(arguments.relations.empty(), "--relations: not on the bus, only with files or --log-in alone");
  RequireUsage(arguments.evo_zip.empty(), "--evo-zip: not on the bus, only with files or --log-in alone");
  RequireUsage(!options.evaluation.calibrate, "--align calibrate: not on the bus, only with files or --log-in alone");
  if (!arguments.estimate.empty()) options.estimate_channel = arguments.estimate;
  if (!arguments.reference.empty()) options.reference_channel = arguments.reference;
  RequireUsage(!NamesFile(options.reference_channel), "--reference: a channel is needed with an estimate on the bus");

  std::vector<EvaluatorService::Outcome> outcomes;
  const ServiceParts parts{EvaluatorService::kName, "", &config, [] {},
                           [&](ServiceContext& context) {
                             return std::make_unique<EvaluatorService>(
                                 options, context,
                                 [&](const EvaluatorService::Outcome& outcome) { outcomes.push_back(outcome); });
                           }};
  ExitCode code = RunOnBus(arguments.service.run, parts);
  if (outcomes.empty() && options.thresholds.Any()) {
    throw CommandError(ExitCode::kNothingMatched, "no poses on " + options.estimate_channel);
  }
  for (const EvaluatorService::Outcome& outcome : outcomes) {
    result::Evaluation message;
    message.set_command(arguments.command);
    message.mutable_estimate()->set_name(outcome.estimate_channel);
    message.mutable_estimate()->set_poses(static_cast<int32_t>(outcome.estimate_poses));
    const bool has_reference = !outcome.reference_channel.empty();
    message.mutable_reference()->set_name(has_reference ? outcome.reference_channel : options.reference_channel);
    message.mutable_reference()->set_poses(static_cast<int32_t>(outcome.reference_poses));
    if (!outcome.text.empty()) message.add_notes(outcome.text);
    const bool any_matched = outcome.evaluation.status == EvaluationStatus::kOk;
    if (any_matched) AddEvaluation(outcome.evaluation, options.evaluation, message);
    const ExitCode judged =
        Report(message, options, JsonPath(arguments.json, outcome.estimate_channel, outcomes.size() == 1));
    if (code == ExitCode::kOk) code = any_matched || judged == ExitCode::kOk ? judged : ExitCode::kNothingMatched;
  }
  return code;
}

}  // namespace

void AddEvaluateOptions(CLI::App& app, EvaluateArguments& arguments, config::Evaluator& flags) {
  app.add_option("--estimate", arguments.estimate, "trajectory file (TUM, KITTI, EuRoC, planar), or channel");
  app.add_option("--reference", arguments.reference, "what it is compared with: file, or channel");
  app.add_option("--relations", arguments.relations, "Kuemmerle relations: lines t1 t2 x y z roll pitch yaw");
  app.add_option("--json", arguments.json, "write the result to this file");
  app.add_option("--evo-zip", arguments.evo_zip, "write the absolute error as evo's evo_ape would, for evo_res");
  app.add_option("--kitti-times", arguments.read.kitti_times, "stamps of KITTI poses, one a line; default 0.1 s apart");
  app.add_option_function<std::string>(
         "--align", [&flags](const std::string& name) { flags.set_align(AlignOf(name)); },
         "how the frames are made one; default: se2 for planar estimates, else se3")
      ->check(CLI::IsMember({"auto", "none", "first", "yaw", "se2", "se3", "calibrate"}));
  AddNumber(app, "--max-gap", "s: largest gap of the reference to interpolate across",
            [&flags](double v) { flags.set_max_gap_s(v); });
  AddNumber(app, "--time-offset", "s: added to the estimate's stamps",
            [&flags](double v) { flags.set_time_offset_s(v); });
  AddThresholdOptions(app, *flags.mutable_thresholds());
}

ExitCode RunEvaluate(const EvaluateArguments& arguments, const config::Evaluator& flags) {
  config::Evaluator config;
  LoadConfig(arguments.service, config);
  config.MergeFrom(flags);
  const EvaluatorOptions options = CompleteOptions(config);
  if (arguments.service.print_config) {
    fmt::print("{}", ConfigText(config));
    return ExitCode::kOk;
  }
  if (IsOnBus(arguments)) return EvaluateOnBus(arguments, options, config);
  WriteEffectiveConfig(arguments.service.run.out, EvaluatorService::kName, config);
  return EvaluateRecording(arguments, options);
}

}  // namespace lcmslam
