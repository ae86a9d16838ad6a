#pragma once

#include <filesystem>

#include "trajectory/evaluate.h"

namespace lcmslam {

namespace result {
class Evaluation;
}

// Writes the absolute error of the positions as evo's `evo_ape --save_results` does (github.com/MichaelGrupp/evo,
// tools/file_interface.py), so that evo_res reads it: info.json, stats.json, error_array.npy and the arrays beside it,
// and both trajectories as TUM, matched and aligned. The same evaluation gives the same bytes. `evaluation` has pairs.
// Throws CommandError (kRuntime) when the file cannot be written.
void WriteEvoArchive(const Evaluation& evaluation, const result::Evaluation& message,
                     const std::filesystem::path& path);

}  // namespace lcmslam
