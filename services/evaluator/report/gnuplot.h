#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lcmslam::report {

// A figure as gnuplot commands, without terminal and output.
struct Figure {
  std::string name;     // of its files; letters, digits, _
  std::string caption;  // what it shows, with units
  std::string script;
  int width = 560, height = 380;  // px of the SVG
};

// Draws all figures by one run of gnuplot into folder/NAME.svg and NAME.pdf. Returns the SVGs, ready to stand in a
// page: no XML declaration, identifiers unique to the figure. Throws CommandError (kRuntime) when gnuplot is absent or
// fails.
std::map<std::string, std::string> DrawFigures(const std::vector<Figure>& figures, const std::filesystem::path& folder);

// A text as gnuplot string, in double quotes, without enhanced-text markup.
std::string GnuplotString(const std::string& text);

}  // namespace lcmslam::report
