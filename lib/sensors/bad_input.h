#pragma once

#include <stdexcept>

namespace lcmslam {

// Thrown by every decoder of this folder when the bytes are not what they should be. what() is one line; readers of
// files put the file and the line or byte offset in front.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lcmslam
