#pragma once

#include <string>

#include "sensors/bad_input.h"

namespace lcmslam {

// What BadInput says when `read()` throws it; "" when it throws nothing.
template <class Read>
std::string ErrorOf(const Read& read) {
  try {
    read();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace lcmslam
