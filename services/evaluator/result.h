#pragma once

#include <filesystem>
#include <string>

#include "evaluator/evaluation.pb.h"
#include "evaluator/options.h"
#include "evaluator/pose_sources.h"

namespace lcmslam {

// Values of lib/trajectory as the message that becomes JSON and table. NaN and infinity are left out.
result::Summary ToMessage(const Summary& summary, double unit = 1.0);
void AddSource(const PoseSource& source, result::Evaluation::Source& message);
// Association, alignment, calibration, all errors.
void AddEvaluation(const Evaluation& evaluation, const EvaluationOptions& options, result::Evaluation& message);
void AddRelations(const RelationErrors& relations, result::Evaluation& message);
// What was demanded and what was reached; call last. True when all demands are met.
bool AddThresholds(const EvaluatorThresholds& thresholds, result::Evaluation& message);

Pose3 ToPose(const result::Evaluation::Pose& pose);

std::string ToJson(const google::protobuf::Message& message);
// Fields of later versions are passed over. Throws CommandError (kBadInput) for a file that is no such message.
void ReadJson(const std::filesystem::path& path, google::protobuf::Message& message);

}  // namespace lcmslam
