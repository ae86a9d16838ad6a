#pragma once

namespace lcmslam::report {

// The style sheet of the page: light and dark, from phone to print.
extern const char* const kStyleSheet;

}  // namespace lcmslam::report
