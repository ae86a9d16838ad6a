#include "evaluator/report/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "trajectory/summary.h"

namespace lcmslam::report {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr size_t kMaxPoints = 2000;  // of one line

using Text = fmt::memory_buffer;

template <typename... Arguments>
void Print(Text& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

// A growing list of plot elements.
class Plot {
 public:
  void Add(const std::string& element) { elements_ += (elements_.empty() ? "" : ", \\\n     ") + element; }
  std::string Command() const { return "plot " + elements_ + "\n"; }

 private:
  std::string elements_;
};

struct Range {
  double min = kInfinity, max = -kInfinity;
  void Include(double value) {
    if (!std::isfinite(value)) return;
    min = std::min(min, value);
    max = std::max(max, value);
  }
  bool IsEmpty() const { return min > max; }
};

Range PositiveRange(const Samples& values) {
  Range range;
  for (const auto& of_system : values) {
    for (const double value : of_system) {
      if (value > 0.0) range.Include(value);
    }
  }
  return range;
}

std::vector<double> Finite(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values;
}

// Several systems may differ by orders of magnitude; then only a logarithmic axis shows them all.
bool NeedsLogAxis(const Samples& values) {
  Range medians;
  for (const auto& of_system : values) medians.Include(Percentile(Finite(of_system), 0.5));
  return !medians.IsEmpty() && medians.max > 5.0 * medians.min;
}

// Ticks at 1, 2 and 5 of every decade, where there are many decades only at 1: gnuplot would show few or none on less
// than two.
void PrintLogAxis(Text& text, const char* axis, const Range& range_m) {
  const double min_mm = 0.8e3 * range_m.min, max_mm = 1.25e3 * range_m.max;
  Print(text, "set logscale {0}\nset {0}range [{1}:{2}]\nset {0}tics ()\n", axis, min_mm, max_mm);
  for (double decade = std::pow(10.0, std::floor(std::log10(min_mm))); decade < max_mm; decade *= 10.0) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (step > 1.0 && max_mm > 1e3 * min_mm) break;
      Print(text, "set {0}tics add (\"{1:g}\" {1:g})\n", axis, step * decade);
    }
  }
}

std::string Line(const std::string& data, const std::string& columns, size_t system, const std::string& title) {
  return fmt::format("{} using {} with lines lw 1.6 lc rgb \"{}\" title {}", data, columns, SystemColour(system),
                     GnuplotString(title));
}

void PrintPath(Text& text, const std::string& data, const Trajectory& trajectory) {
  const size_t stride = trajectory.size() / kMaxPoints + 1;
  Print(text, "{} << EOD\n", data);
  for (size_t i = 0; i < trajectory.size(); i += stride) {
    Print(text, "{:.4f} {:.4f}\n", trajectory[i].pose.translation.x(), trajectory[i].pose.translation.y());
  }
  Print(text, "EOD\n");
}

// Names that do not fit side by side below an axis are slanted.
const char* SlantIfLong(const std::vector<std::string>& names) {
  constexpr size_t kRoom = 48;  // letters
  size_t letters = 0;
  for (const std::string& name : names) letters = std::max(letters, name.size());
  return letters * names.size() > kRoom ? " rotate by 30 right" : "";
}

// What has to be seen: the reference, or without one all estimates; a lost system may leave the picture.
void PrintExtent(Text& text, const EpisodeCurves& curves) {
  Range x, y;
  const auto include = [&](const Trajectory& trajectory) {
    for (const StampedPose& pose : trajectory) {
      x.Include(pose.pose.translation.x());
      y.Include(pose.pose.translation.y());
    }
  };
  include(curves.reference);
  if (x.IsEmpty()) {
    for (const auto& [system, curve] : curves.systems) include(curve.trajectory);
  }
  if (x.IsEmpty()) return;
  const double margin_m = 0.08 * std::max({x.max - x.min, y.max - y.min, 0.1});
  Print(text, "set xrange [{}:{}]\nset yrange [{}:{}]\n", x.min - margin_m, x.max + margin_m, y.min - margin_m,
        y.max + margin_m);
}

}  // namespace

std::string SystemColour(size_t index) {
  constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
  return kColours[index % kColours.size()];
}

Figure BoxPlot(const std::string& name, const std::string& caption, const std::string& axis,
               const std::vector<std::string>& systems, const Samples& values_m) {
  constexpr size_t kShowPointsUpTo = 300;
  Text text;
  Plot plot;
  std::string tics;
  for (size_t i = 0; i < systems.size(); ++i) {
    const std::vector<double> values = Finite(values_m[i]);
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", GnuplotString(systems[i]), i + 1);
    if (values.empty()) continue;
    Print(text, "$values{} << EOD\n", i);
    for (const double value_m : values) Print(text, "{:.6g}\n", 1e3 * value_m);
    Print(text, "EOD\n");
    const bool shows_points = values.size() <= kShowPointsUpTo;
    plot.Add(
        fmt::format("$values{} using ({}):1 with boxplot lc rgb \"{}\" lw 1.4 notitle", i, i + 1, SystemColour(i)));
    if (shows_points) {
      plot.Add(fmt::format("$values{} using ({}):1 with points pt 7 ps 0.35 lc rgb \"{}\" notitle", i, i + 1.35,
                           SystemColour(i)));
    }
  }
  NeedsLogAxis(values_m) ? PrintLogAxis(text, "y", PositiveRange(values_m)) : Print(text, "set yrange [0:]\n");
  Print(text, "set style boxplot nooutliers fraction 0.95\nset boxwidth 0.4\nset style fill solid 0.25 border\n");
  Print(text, "set tmargin 1\nset xtics ({}) noenhanced scale 0{}\nset xrange [0.4:{}]\nset ylabel {}\n", tics,
        SlantIfLong(systems), static_cast<double>(systems.size()) + 0.8, GnuplotString(axis));
  return {name, caption, fmt::to_string(text) + plot.Command()};
}

Figure Histogram(const std::string& name, const std::string& caption, const std::vector<std::string>& systems,
                 const Samples& values_m) {
  constexpr int kBins = 60;
  Range range = PositiveRange(values_m);
  const bool log = NeedsLogAxis(values_m);
  if (log) {  // from where hardly anything lies below
    Range low;
    for (const auto& values : values_m) low.Include(Percentile(Finite(values), 0.01));
    range.min = std::max({range.min, low.min, 1e-6 * range.max});
  } else {  // from 0 to where hardly anything is left
    range.max = 0.0;
    for (const auto& values : values_m) range.max = std::max(range.max, 1.05 * Percentile(Finite(values), 0.995));
  }
  const auto bin_of = [&](double value) {
    const double share = log ? std::log(value / range.min) / std::log(range.max / range.min) : value / range.max;
    return std::clamp(static_cast<int>(std::floor(share * kBins)), -1, kBins);
  };
  const auto edge_mm = [&](int bin) {
    const double share = static_cast<double>(bin) / kBins;
    return 1e3 * (log ? range.min * std::pow(range.max / range.min, share) : range.max * share);
  };
  Text text;
  Plot plot;
  for (size_t i = 0; i < systems.size(); ++i) {
    std::array<int64_t, kBins> counts{};
    for (const double value : values_m[i]) {
      const int bin = std::isfinite(value) && value >= 0.0 ? bin_of(std::max(value, 1e-12)) : kBins;
      if (bin >= 0 && bin < kBins) ++counts[static_cast<size_t>(bin)];
    }
    if (values_m[i].empty()) continue;
    Print(text, "$counts{} << EOD\n", i);
    for (int bin = 0; bin < kBins; ++bin) {
      const double share =
          static_cast<double>(counts[static_cast<size_t>(bin)]) / static_cast<double>(values_m[i].size());
      Print(text, "{:.6g} {:.4f}\n{:.6g} {:.4f}\n", edge_mm(bin), 100 * share, edge_mm(bin + 1), 100 * share);
    }
    Print(text, "EOD\n");
    plot.Add(fmt::format("$counts{} using 1:2 with filledcurves y1=0 fs transparent solid 0.25 lc rgb \"{}\" notitle",
                         i, SystemColour(i)));
    plot.Add(Line(fmt::format("$counts{}", i), "1:2", i, systems[i]));
  }
  log ? PrintLogAxis(text, "x", range) : Print(text, "set xrange [0:{}]\n", edge_mm(kBins));
  Print(text, "set yrange [0:]\n");
  Print(text, "set xlabel \"position error [mm]\"\nset ylabel \"share of poses [%]\"\n");
  return {name, caption, fmt::to_string(text) + plot.Command()};
}

Figure TrajectoryPlot(const std::string& name, const std::string& caption, const std::vector<std::string>& systems,
                      const EpisodeCurves& curves) {
  Text text;
  Plot plot;
  if (!curves.reference.empty()) {
    PrintPath(text, "$reference", curves.reference);
    plot.Add("$reference using 1:2 with lines lw 4 lc rgb \"#AAAAAA\" title \"reference\"");
  }
  for (size_t i = 0; i < systems.size(); ++i) {
    const auto curve = curves.systems.find(systems[i]);
    if (curve == curves.systems.end()) continue;
    PrintPath(text, fmt::format("$path{}", i), curve->second.trajectory);
    plot.Add(Line(fmt::format("$path{}", i), "1:2", i, systems[i]));
  }
  PrintExtent(text, curves);
  Print(text, "set size ratio -1\nset xlabel \"x [m]\"\nset ylabel \"y [m]\"\n");
  return {name, caption, fmt::to_string(text) + plot.Command(), 560, 520};
}

Figure ErrorOverTime(const std::string& name, const std::string& caption, const std::vector<std::string>& systems,
                     const EpisodeCurves& curves) {
  Text text;
  Plot plot;
  Samples errors_m;
  for (size_t i = 0; i < systems.size(); ++i) {
    const auto entry = curves.systems.find(systems[i]);
    if (entry == curves.systems.end()) continue;
    const SystemCurve& curve = entry->second;
    errors_m.push_back(curve.error_m);
    const size_t stride = curve.error_m.size() / kMaxPoints + 1;
    Print(text, "$error{} << EOD\n", i);
    for (size_t k = 0; k < curve.error_m.size(); k += stride) {
      Print(text, "{:.3f} {:.6g}\n", curve.time_s[k], 1e3 * curve.error_m[k]);
    }
    Print(text, "EOD\n");
    plot.Add(Line(fmt::format("$error{}", i), "1:2", i, systems[i]));
  }
  if (NeedsLogAxis(errors_m)) {
    Range range = PositiveRange(errors_m);
    range.min = std::max(range.min, 1e-3 * range.max);
    PrintLogAxis(text, "y", range);
  } else {
    Print(text, "set yrange [0:]\n");
  }
  Print(text, "set xlabel \"time [s]\"\nset ylabel \"position error [mm]\"\n");
  return {name, caption, fmt::to_string(text) + plot.Command()};
}

Figure TimingPlot(const std::string& name, const std::string& caption, const Group& group) {
  Text text;
  Plot plot;
  std::string tics;
  for (size_t i = 0; i < group.systems.size(); ++i) {
    std::vector<double> medians, p95s, maxima, latency_p50s, latency_p99s;
    for (const Episode& episode : group.episodes) {
      const auto& timing = episode.runs.at(group.systems[i]).metrics.timing();
      if (timing.has_latency_p50_ms()) {
        latency_p50s.push_back(timing.latency_p50_ms());
        latency_p99s.push_back(timing.latency_p99_ms());
      }
      if (!timing.has_step_ms()) continue;
      medians.push_back(timing.step_ms().median());
      p95s.push_back(timing.step_ms().p95());
      maxima.push_back(timing.step_ms().max());
    }
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", GnuplotString(group.systems[i]), i + 1);
    if (!latency_p50s.empty()) {
      Print(text, "$latency{} << EOD\n{} {:.4g} {:.4g}\nEOD\n", i, static_cast<double>(i) + 1.25,
            Percentile(latency_p50s, 0.5), *std::ranges::max_element(latency_p99s));
      plot.Add(fmt::format("$latency{} using 1:2:2:3 with yerrorbars pt 6 ps 1.1 lw 1.6 lc rgb \"{}\" notitle", i,
                           SystemColour(i)));
    }
    if (medians.empty()) continue;
    Print(text, "$time{} << EOD\n{} {:.4g} {:.4g} {:.4g}\nEOD\n", i, i + 1, Percentile(medians, 0.5),
          Percentile(p95s, 0.5), *std::ranges::max_element(maxima));
    const std::string colour = SystemColour(i);
    plot.Add(fmt::format("$time{} using 1:2:2:4 with yerrorbars pt 0 lw 1 lc rgb \"{}\" notitle", i, colour));
    plot.Add(fmt::format("$time{} using 1:2:2:3 with yerrorbars pt 7 ps 1.1 lw 6 lc rgb \"{}\" notitle", i, colour));
  }
  Figure figure{name, caption, ""};
  if (text.size() == 0) return figure;
  Print(text,
        "set tmargin 1\nset logscale y\nset xtics ({}) noenhanced scale 0{}\nset xrange [0.4:{}]\nset ylabel \"time of "
        "a scan [ms]\"\n",
        tics, SlantIfLong(group.systems), static_cast<double>(group.systems.size()) + 0.6);
  figure.script = fmt::to_string(text) + plot.Command();
  return figure;
}

}  // namespace lcmslam::report
