#include "evaluator/report/gnuplot.h"

#include <cstdio>
#include <cstdlib>
#include <regex>

#include <fmt/format.h>

#include "bus/errors.h"
#include "evaluator/files.h"
#include "evaluator/report/table.h"

namespace lcmslam::report {
namespace {

// What all figures have in common. Black becomes the page's ink, see style.cc.
constexpr const char* kHead = R"(set encoding utf8
set border 3 lw 0.75
set tics nomirror out scale 0.6
set grid lc rgb "#888888" lw 0.4 dt (2,4)
set key at screen 0.03, 0.99 left top Left reverse samplen 1.5 horizontal maxrows 1 noenhanced
set tmargin 3
set bars small
)";

std::string Script(const std::vector<Figure>& figures, const std::filesystem::path& folder) {
  std::string script;
  for (const Figure& figure : figures) {
    const std::string path = (folder / figure.name).string();
    const std::string data_and_plot = "reset\n" + std::string(kHead) + figure.script + "\n";
    script += fmt::format("set terminal svg size {},{} dynamic enhanced font 'sans-serif,14' name '{}'\n", figure.width,
                          figure.height, figure.name);
    script += fmt::format("set output {}\n{}", GnuplotString(path + ".svg"), data_and_plot);
    script += fmt::format("set terminal pdfcairo size {:.3f}in,{:.3f}in enhanced font 'sans-serif,11'\n",
                          figure.width / 100.0, figure.height / 100.0);
    script += fmt::format("set output {}\n{}", GnuplotString(path + ".pdf"), data_and_plot);
  }
  return script + "unset output\n";
}

// gnuplot gives the same identifiers to the symbols of every figure; in one page they must differ.
std::string ReadyForPage(const std::string& svg, const std::string& name) {
  const std::string body = svg.substr(std::min(svg.find("<svg"), svg.size()));
  static const std::regex identifier("(id=['\"]|href=['\"]#|url\\(#)");
  return std::regex_replace(body, identifier, "$1" + name + "_");
}

// The same as a shell would do, for a path of any characters.
std::string ShellQuote(const std::string& text) {
  return "'" + std::regex_replace(text, std::regex("'"), "'\\''") + "'";
}

}  // namespace

std::map<std::string, std::string> DrawFigures(const std::vector<Figure>& figures,
                                               const std::filesystem::path& folder) {
  std::map<std::string, std::string> svgs;
  if (figures.empty()) return svgs;
  const std::filesystem::path script = folder / "figures.gp", log = folder / "figures.log";
  WriteFile(script, Script(figures, folder));
  const std::string command = fmt::format("gnuplot {} >{} 2>&1", ShellQuote(script.string()), ShellQuote(log.string()));
  if (std::system(command.c_str()) != 0) {
    throw CommandError(ExitCode::kRuntime,
                       fmt::format("gnuplot (Debian: gnuplot-nox) failed, {} says why", log.string()));
  }
  std::filesystem::remove(log);
  for (const Figure& figure : figures) {
    svgs[figure.name] = ReadyForPage(ReadFile(folder / (figure.name + ".svg")), figure.name);
  }
  return svgs;
}

std::string GnuplotString(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + "\"";
}

}  // namespace lcmslam::report
