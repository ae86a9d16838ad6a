#pragma once

#include <string>
#include <vector>

#include "evaluator/report/curves.h"
#include "evaluator/report/gnuplot.h"
#include "evaluator/report/study.h"

namespace lcmslam::report {

// The colour of the i-th system, the same in every figure: Okabe and Ito's palette, told apart by colour-blind people.
std::string SystemColour(size_t index);

// Values of each system, e.g. one an episode or one a pose; infinite ones (failures) are not drawn.
using Samples = std::vector<std::vector<double>>;

// `axis` says what the values are, with unit mm.
Figure BoxPlot(const std::string& name, const std::string& caption, const std::string& axis,
               const std::vector<std::string>& systems, const Samples& values_m);
Figure Histogram(const std::string& name, const std::string& caption, const std::vector<std::string>& systems,
                 const Samples& values_m);
Figure TrajectoryPlot(const std::string& name, const std::string& caption, const std::vector<std::string>& systems,
                      const EpisodeCurves& curves);
Figure ErrorOverTime(const std::string& name, const std::string& caption, const std::vector<std::string>& systems,
                     const EpisodeCurves& curves);
// Median, p95 and largest time of a scan over all episodes of the group that know it. No script when none does.
Figure TimingPlot(const std::string& name, const std::string& caption, const Group& group);

}  // namespace lcmslam::report
