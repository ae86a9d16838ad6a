#include "evaluator/report/page.h"

#include <map>
#include <set>

#include <fmt/format.h>

#include "bus/errors.h"
#include "evaluator/files.h"
#include "evaluator/report/encodings.h"
#include "evaluator/report/overview.h"
#include "evaluator/report/section.h"
#include "evaluator/report/style.h"
#include "evaluator/report/table.h"

namespace lcmslam::report {
namespace {

namespace fs = std::filesystem;

std::string FiguresHtml(const std::vector<Figure>& figures, const std::map<std::string, std::string>& svgs) {
  std::string html = "<div class=\"figures\">\n";
  for (const Figure& figure : figures) {
    html += fmt::format("<figure id=\"{}\">{}<figcaption>{}</figcaption></figure>\n", figure.name, svgs.at(figure.name),
                        EscapeHtml(figure.caption));
  }
  return html + "</div>\n";
}

std::string SectionHtml(const Section& section, const std::map<std::string, std::string>& svgs) {
  std::string html = fmt::format("<h2>{}</h2>\n", EscapeHtml(section.heading));
  for (const std::string& verdict : section.verdicts) {
    html += fmt::format("<p class=\"verdict\">{}</p>\n", EscapeHtml(verdict));
  }
  for (const Table& table : section.tables) html += ToHtml(table);
  html += FiguresHtml(section.figures, svgs);
  for (const Showcase& showcase : section.showcases) {
    if (!showcase.heading.empty()) html += fmt::format("<h3>{}</h3>\n", EscapeHtml(showcase.heading));
    html += FiguresHtml(showcase.figures, svgs);
    html += "<div class=\"figures\">\n";
    for (const std::string& map : showcase.map_figures) html += map;
    html += "</div>\n";
  }
  return html + fmt::format("<details><summary>All episodes</summary>{}</details>\n", ToHtml(section.episodes));
}

// What a reader of the numbers must know besides.
std::vector<std::string> NotesOf(const result::Evaluation& m) {
  std::vector<std::string> notes(m.notes().begin(), m.notes().end());
  if (!m.alignment().unobservable().empty()) notes.push_back(m.alignment().unobservable());
  if (m.has_calibration()) {
    const auto& c = m.calibration();
    const auto& arm = c.t_body_marker();
    notes.push_back(fmt::format("calibrated: time offset {:.5f} s, lever arm ({:.4f}, {:.4f}, {:.4f}) m",
                                c.time_offset_s(), arm.x_m(), arm.y_m(), arm.z_m()));
    if (c.unexcited_size() > 0) {
      notes.push_back(fmt::format("the motion does not excite {}", fmt::join(c.unexcited(), ", ")));
    }
  }
  return notes;
}

// How the poses of a run were paired and the frames made one.
std::string AlignmentOf(const result::Evaluation& m) {
  static const std::map<std::string, std::string> kMeanings = {
      {"none", "none (the frames are taken to be the same)"},
      {"first", "first (the first poses are made equal)"},
      {"yaw", "yaw (least squares over x, y, z and yaw)"},
      {"se2", "se2 (least squares over x, y and yaw; z, roll and pitch are left out)"},
      {"se3", "se3 (least squares over x, y, z and rotation)"}};
  const auto meaning = kMeanings.find(m.alignment().kind());
  return fmt::format("{}{}, across gaps of up to {:g} s, time offset {:g} s",
                     meaning == kMeanings.end() ? m.alignment().kind() : meaning->second,
                     m.has_calibration() ? " with calibration of time offset and marker" : "",
                     m.association().max_gap_s(), m.association().time_offset_s());
}

// Alignments, gaps and commands that occur in the study.
std::string MethodHtml(const Study& study, const PageOptions& options) {
  std::set<std::string> alignments, commands, notes;
  for (const Group& group : study.groups) {
    for (const Episode& episode : group.episodes) {
      for (const auto& [system, run] : episode.runs) {
        const result::Evaluation& m = run.metrics;
        if (m.has_alignment()) alignments.insert(AlignmentOf(m));
        for (const std::string& note : NotesOf(m)) notes.insert(fmt::format("{}, {}: {}", episode.name, system, note));
        for (const std::string& command : {m.command(), run.map_quality.command()}) {
          if (!command.empty()) commands.insert(command);
        }
      }
    }
  }
  std::string html =
      "<h2>How these numbers came about</h2>\n<p>The reference is interpolated (linear, SLERP) at the stamps of "
      "the estimate, never extrapolated; coverage is the share of the estimate's poses that found a partner. The "
      "frames are made one without scale. Alignment: ";
  html += EscapeHtml(fmt::format("{}", fmt::join(alignments, "; or "))) + ". ";
  html += fmt::format(
      "An episode counts as failed, by a rule that stood before the runs were looked at, when its mean error is above "
      "{:g} m, its coverage below {:g} %, or there is no result; failed episodes are never dropped and rank worst. p95 "
      "is linear between order statistics.</p>\n",
      study.failure_rule.max_mean_m, 100.0 * study.failure_rule.min_coverage);
  for (const std::string& note : notes) html += fmt::format("<p class=\"soft\">{}</p>\n", EscapeHtml(note));
  html += fmt::format("<p>This page: <code>{}</code></p>\n", EscapeHtml(options.command));
  html +=
      fmt::format("<details><summary>Commands of the evaluations, {} different ones</summary><pre>", commands.size());
  for (const std::string& command : commands) html += EscapeHtml(command) + "\n";
  return html + "</pre></details>\n";
}

// Each different effective configuration once, with how many runs had it.
std::string ConfigurationsHtml(const Study& study) {
  std::map<std::string, std::map<std::string, int>> runs;  // by system and text
  for (const Group& group : study.groups) {
    for (const Episode& episode : group.episodes) {
      for (const auto& [system, run] : episode.runs) {
        if (!run.config.empty()) ++runs[system][ReadFile(run.config)];
      }
    }
  }
  std::string html = "<h2>Configurations</h2>\n";
  if (runs.empty()) return html + "<p>None was recorded.</p>\n";
  for (const auto& [system, texts] : runs) {
    for (const auto& [text, count] : texts) {
      html += fmt::format("<details><summary>{} ({} run{})</summary><pre>{}</pre></details>\n", EscapeHtml(system),
                          count, count == 1 ? "" : "s", EscapeHtml(text));
    }
  }
  return html;
}

// Each in an image of its own: identifiers of several drawings may be the same.
std::string PicturesHtml(const std::vector<fs::path>& pictures) {
  if (pictures.empty()) return "";
  std::string html = "<h2>Measured beside</h2>\n<div class=\"figures\">\n";
  for (const fs::path& picture : pictures) {
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/svg+xml;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        EscapeHtml(picture.stem().string()), Base64(ReadFile(picture)));
  }
  return html + "</div>\n";
}

Table InputsTable(const Study& study, const std::vector<fs::path>& pictures) {
  Table table{"inputs", "SHA-256 of every file that went into this page.", {"file", "SHA-256"}, {}, 2};
  const auto add = [&](const fs::path& file) {
    if (!file.empty()) table.rows.push_back({file.string(), Sha256(ReadFile(file))});
  };
  for (const fs::path& picture : pictures) add(picture);
  for (const Group& group : study.groups) {
    for (const Episode& episode : group.episodes) {
      add(episode.reference);
      add(episode.bound_file);
      for (const auto& [system, run] : episode.runs) {
        for (const fs::path& file : {run.metrics_file, run.trajectory, run.map, run.map_quality_file, run.config})
          add(file);
      }
    }
  }
  return table;
}

fs::path MakeFolder(const fs::path& page) {
  const fs::path folder = page.parent_path() / (page.stem().string() + "_files");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw CommandError(ExitCode::kRuntime, fmt::format("{}: {}", folder.string(), error.message()));
  return folder;
}

void WriteTables(const std::string& name, const Section& section, const fs::path& folder) {
  for (const Table& table : section.tables) WriteFile(folder / (name + "_" + table.name + ".csv"), ToCsv(table));
  WriteFile(folder / (name + "_episodes.csv"), ToCsv(section.episodes));
}

}  // namespace

void WritePage(const Study& study, const PageOptions& options) {
  const fs::path folder = MakeFolder(options.file);
  std::vector<Section> sections;
  std::vector<Figure> figures;
  for (size_t i = 0; i < study.groups.size(); ++i) {
    const std::string name = fmt::format("group{}", i + 1);
    sections.push_back(MakeSection(study.groups[i], name));
    const Section& section = sections.back();
    WriteTables(name, section, folder);
    figures.insert(figures.end(), section.figures.begin(), section.figures.end());
    for (const Showcase& showcase : section.showcases) {
      figures.insert(figures.end(), showcase.figures.begin(), showcase.figures.end());
    }
  }
  const std::map<std::string, std::string> svgs = DrawFigures(figures, folder);

  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      EscapeHtml(options.title), kStyleSheet);
  if (!options.note.empty()) html += fmt::format("<p>{}</p>\n", EscapeHtml(options.note));
  for (const Table& table : {MedianTable(study), OverviewTable(study)}) {
    WriteFile(folder / (table.name + ".csv"), ToCsv(table));
    if (study.groups.size() > 1) html += ToHtml(table);
  }
  for (const Section& section : sections) html += SectionHtml(section, svgs);
  html += PicturesHtml(options.pictures);
  html += MethodHtml(study, options);
  html += ConfigurationsHtml(study);
  const Table inputs = InputsTable(study, options.pictures);
  WriteFile(folder / "inputs.csv", ToCsv(inputs));
  html += "<h2>Inputs</h2>\n<details class=\"hash\"><summary>Files and their SHA-256</summary>" + ToHtml(inputs) +
          "</details>\n</body>\n</html>\n";
  WriteFile(options.file, html);
}

}  // namespace lcmslam::report
