#pragma once

#include <string>
#include <vector>

namespace lcmslam::testing {

struct Outcome {
  int code = 0;
  std::string out, error;
};

// What the program `evaluator` does with these arguments.
Outcome RunEvaluator(std::vector<std::string> arguments);

// That it ended with this code and a single line on stderr, which holds `error`.
void ExpectRefused(const std::vector<std::string>& arguments, int code, const std::string& error);

}  // namespace lcmslam::testing
