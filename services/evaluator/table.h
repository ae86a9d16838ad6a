#pragma once

#include <string>

namespace lcmslam {

namespace result {
class Evaluation;
}

// The evaluation for people: every number with its unit, and how it came about.
std::string FormatTable(const result::Evaluation& evaluation);

}  // namespace lcmslam
