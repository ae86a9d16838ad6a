#pragma once

#include <string>
#include <vector>

#include "evaluator/report/gnuplot.h"
#include "evaluator/report/study.h"
#include "evaluator/report/table.h"

namespace lcmslam::report {

// An episode that is shown in pictures.
struct Showcase {
  std::string heading;  // "" where there is only one
  std::vector<Figure> figures;
  std::vector<std::string> map_figures;  // HTML
};

// What the page says of one group, before it is HTML.
struct Section {
  std::string heading;
  std::vector<std::string> verdicts;
  std::vector<Table> tables;
  std::vector<Figure> figures;
  std::vector<Showcase> showcases;
  Table episodes;
};

// `name` starts the names of all files of the section.
Section MakeSection(const Group& group, const std::string& name);

}  // namespace lcmslam::report
