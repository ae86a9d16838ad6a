#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/errors.h"
#include "evaluator/files.h"
#include "evaluator/report/encodings.h"
#include "evaluator/report/map_image.h"
#include "evaluator/report/numbers.h"
#include "evaluator/report/overview.h"
#include "evaluator/report/page.h"
#include "evaluator/report/quality_tables.h"
#include "evaluator/report/speed_table.h"
#include "evaluator/report/study.h"
#include "evaluator/report/study_tables.h"
#include "evaluator/result.h"
#include "trajectory/write.h"

namespace lcmslam::report {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lcmslam_report_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static Trajectory Circle(double radius_m) {
    Trajectory t;
    for (int k = 0; k <= 100; ++k) {
      t.push_back(
          {1'000'000 + k * 100'000, ToPose3(Pose2(radius_m * std::cos(0.05 * k), radius_m * std::sin(0.05 * k), 0.0))});
    }
    return t;
  }

  // What replay leaves of one episode: the estimate is `error_m` too far out.
  void WriteRun(const std::string& episode, const std::string& system, double error_m, double coverage = 1.0) {
    const fs::path folder = folder_ / episode;
    fs::create_directories(folder);
    ASSERT_EQ(WriteTum(folder / "ground_truth_000_tum.txt", Circle(2.0)), "");
    ASSERT_EQ(WriteTum(folder / (system + "_tum.txt"), Circle(2.0 + error_m)), "");
    EvaluationOptions options;
    options.alignment = AlignmentKind::kNone;
    result::Evaluation message;
    message.set_command("evaluator <" + episode + ">");
    AddEvaluation(Evaluate(Circle(2.0 + error_m), Circle(2.0), options), options, message);
    message.mutable_association()->set_coverage(coverage);
    Write(episode + "/" + system + "_metrics.json", ToJson(message));
    Write(episode + "/" + system + ".pbtxt", "cell_m: 0.05\n");
    Write(episode + "/" + system + "_map.pgm",
          "P5\n4 3\n255\n" + std::string("\xcd\xcd\xcd\xcd\xcd\x00\xfe\xcd\xcd\xcd\xcd\xcd", 12));
    Write(episode + "/" + system + "_map.yaml", "image: x\nresolution: 0.05\n");
  }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string ReadPage() const { return ReadFile(folder_ / "out.html"); }

  fs::path folder_;
};

TEST_F(Report, LoadsEpisodesByFolder) {
  for (const char* episode : {"sim/e1", "sim/e2", "sim/deep/e3"}) {
    WriteRun(episode, "occupancy2d-slam", 0.02);
    WriteRun(episode, "sdf2d-slam", 0.01);
  }
  WriteRun("single", "sdf2d-slam", 0.01);
  const Study study = LoadStudy({folder_ / "sim", folder_ / "single"}, {});
  EXPECT_THAT(study.systems, ElementsAre("sdf2d-slam", "occupancy2d-slam")) << "ours first";
  ASSERT_EQ(study.groups.size(), 2u);
  EXPECT_EQ(study.groups[0].episodes[0].name, "single");
  EXPECT_EQ(study.groups[1].name, "sim");
  ASSERT_EQ(study.groups[1].episodes.size(), 3u);
  EXPECT_EQ(study.groups[1].episodes[0].name, "deep/e3");
  EXPECT_NEAR(TranslationError(study.groups[1].episodes[0].runs.at("sdf2d-slam")), 0.01, 1e-9);
}

TEST_F(Report, FailuresAreNeverDropped) {
  WriteRun("e/good", "a", 0.01);
  WriteRun("e/good", "b", 0.02);
  WriteRun("e/lost", "a", 0.01);
  WriteRun("e/lost", "b", 0.7);
  WriteRun("e/thin", "a", 0.01);
  WriteRun("e/thin", "b", 0.01, 0.5);
  WriteRun("e/dead", "a", 0.01);
  const Study study = LoadStudy({folder_ / "e"}, {.max_mean_m = 0.5, .min_coverage = 0.9});
  const Group& group = study.groups[0];
  EXPECT_THAT(TranslationErrors(group, "b"),
              ElementsAre(kInfinity, ::testing::DoubleNear(0.02, 1e-9), kInfinity, kInfinity));
  const EpisodeSummary b = SummarizeEpisodes(TranslationErrors(group, "b"));
  EXPECT_EQ(b.completed, 1);
  EXPECT_EQ(b.episodes, 4);
  EXPECT_EQ(b.median, kInfinity);
  EXPECT_NEAR(b.mean, 0.02, 1e-9);
  const Table episodes = EpisodesTable(group);
  std::vector<std::string> failures;
  for (const auto& row : episodes.rows) failures.push_back(row.back());
  EXPECT_THAT(failures, ElementsAre("", "no result", "", "", "", "mean error 0.700 m", "", "coverage 50.0 %"));
  const auto comparisons = CompareSystems(group);
  ASSERT_EQ(comparisons.size(), 2u);
  EXPECT_EQ(comparisons[0].paired.wins_a, 4);
}

// A run in space and two in the plane: a system that did not run has not failed.
TEST_F(Report, SystemsThatNeverMetAreNotCompared) {
  for (const char* episode : {"out/hall", "out/vault"}) WriteRun(episode, "octo3d-slam", 0.01);
  for (const char* system : {"sdf2d-slam", "occupancy2d-slam"}) WriteRun("out/room", system, 0.02);
  WriteRun("out/yard", "occupancy2d-slam", 0.03);
  for (const auto& folders :
       {std::vector<fs::path>{folder_ / "out"},
        {folder_ / "out/hall", folder_ / "out/room", folder_ / "out/vault", folder_ / "out/yard"}}) {
    const Study study = LoadStudy(folders, {});
    ASSERT_EQ(study.groups.size(), 2U);
    const Group &space = study.groups[0], &plane = study.groups[1];
    EXPECT_THAT(space.name, HasSubstr(": octo3d-slam"));
    EXPECT_THAT(plane.systems, ElementsAre("sdf2d-slam", "occupancy2d-slam"));
    EXPECT_THAT(TranslationErrors(space, "octo3d-slam"), ElementsAre(::testing::Lt(0.1), ::testing::Lt(0.1)));
    EXPECT_THAT(TranslationErrors(plane, "sdf2d-slam"), ElementsAre(::testing::Lt(0.1), kInfinity)) << "met the other";
    EXPECT_THAT(MedianTable(study).rows[2], ElementsAre("octo3d-slam", "10.00", "-"));
    EXPECT_EQ(EpisodesTable(space).rows.size(), 2U);
  }
}

TEST_F(Report, MediansOfGroupsSideBySide) {
  for (const char* episode : {"g/1", "g/2", "g/3", "h/1"}) WriteRun(episode, "a", 0.02);
  for (const char* episode : {"g/1", "g/2", "h/1"}) WriteRun(episode, "b", 0.04);
  const Table table = MedianTable(LoadStudy({folder_ / "g", folder_ / "h"}, {}));
  EXPECT_THAT(table.header, ElementsAre("system", "g", "h"));
  EXPECT_THAT(table.rows, ElementsAre(ElementsAre("a", "20.0", "20.0"), ElementsAre("b", "40.0 (1 of 3)", "40.0")));
}

TEST(PoseErrorTable, HoldsMeanAndSdOfPositionAndRotation) {
  Group group{.name = "", .systems = {"a"}, .episodes = {}};
  Episode episode;
  result::PoseError& error = *episode.runs["a"].metrics.mutable_absolute();
  error.mutable_translation_m()->set_mean(0.004);
  error.mutable_translation_m()->set_sd(0.003);
  error.mutable_rotation_rad()->set_mean(0.002);
  error.mutable_rotation_rad()->set_sd(0.001);
  const Table table = PoseErrorTable(group, episode);
  ASSERT_EQ(table.rows.size(), 1U);
  ASSERT_EQ(table.rows[0].size(), table.header.size());
  std::map<std::string, std::string> cells;
  for (size_t i = 0; i < table.header.size(); ++i) cells[table.header[i]] = table.rows[0][i];
  EXPECT_EQ(cells["mean [mm]"], "4.00");
  EXPECT_EQ(cells["SD [mm]"], "3.00");
  EXPECT_EQ(cells["rot. [mrad]"], "2.00");
  EXPECT_EQ(cells["rot. SD [mrad]"], "1.00");
}

// 5,000 registrations of 0.2 ms in a second; 4 iterations in 0.2 ms, 6 in 0.2 ms: 20,000 and 30,000.
TEST(SpeedTable, CountsRegistrationsAndTheirIterations) {
  Group group{.name = "", .systems = {"a", "b"}, .episodes = {}};
  for (const double iterations : {4.0, 6.0}) {
    Episode episode;
    result::Timing& timing = *episode.runs["a"].metrics.mutable_timing();
    timing.mutable_step_ms()->set_mean(0.8);
    timing.mutable_step_ms()->set_median(0.5);
    timing.mutable_step_ms()->set_p95(0.9);
    timing.mutable_iterations()->set_mean(iterations);
    for (const char* name : {"register", "fuse"}) {
      result::Timing::Stage& stage = *timing.add_stages();
      stage.set_name(name);
      stage.mutable_ms()->set_mean(0.2);
      stage.mutable_ms()->set_median(0.2);
      stage.mutable_ms()->set_p95(0.3);
    }
    episode.runs["b"] = {};
    group.episodes.push_back(episode);
  }
  EXPECT_THAT(SpeedTable(group).rows,
              ElementsAre(ElementsAre("a", "whole scan", "0.500", "0.900", "1250", "", ""),
                          ElementsAre("a", "fuse", "0.200", "0.300", "5000", "", ""),
                          ElementsAre("a", "register", "0.200", "0.300", "5000", "5.00", "25000")));
}

TEST(SummarizeEpisodes, RanksFailuresWorst) {
  const EpisodeSummary s = SummarizeEpisodes({4.0, 1.0, kInfinity, 2.0, 3.0});
  EXPECT_EQ(s.median, 3.0);
  EXPECT_EQ(s.p95, kInfinity);
  EXPECT_EQ(s.max, kInfinity);
  EXPECT_EQ(s.mean, 2.5);
  EXPECT_NEAR(s.sd, std::sqrt(5.0 / 3.0), 1e-12);
  EXPECT_TRUE(std::isnan(SummarizeEpisodes({}).median));
  EXPECT_TRUE(std::isnan(SummarizeEpisodes({1.0}).sd));
}

// The scans' bounds are 3 and 4 mm: 3.5 mm on average, root mean square sqrt(12.5) mm.
TEST_F(Report, ErrorsAreSetAgainstTheBound) {
  for (const char* episode : {"low/e1", "low/e2", "low/e3", "none/e1"}) {
    WriteRun(episode, "a", 0.007);
    WriteRun(episode, "b", 0.014);
    Write(std::string(episode) + "/bound.csv",
          "utime_us,position_m,yaw_rad\n100,0.003,0.1\n200,0.004,0.1\n300,inf,inf\n");
  }
  Write("none/e1/bound.csv", "utime_us,position_m,yaw_rad\n100,0,0\n");
  fs::remove(folder_ / "low/e1/bound.csv");
  const Study study = LoadStudy({folder_ / "low", folder_ / "none"}, {});
  const Table overview = OverviewTable(study);
  ASSERT_EQ(overview.rows.size(), 4u);
  EXPECT_THAT(overview.rows[0], ElementsAre("low", "a", "3/3", "7.00", "7.00", "0.00", "0.00", "0.00", "1.00", "1.00",
                                            "-", "2.00", "-", "-", "-", "-"));
  EXPECT_THAT(overview.rows[1], ElementsAre("low", "b", "3/3", "14.0", "14.0", "0.00", "0.00", "0.00", "2.00", "2.00",
                                            "-", "4.00", "-", "-", "-", "-"));
  EXPECT_EQ(overview.rows[2][11], "-") << "no noise, no bound";
  const Table systems = SystemsTable(study.groups[0]);
  EXPECT_EQ(systems.header[11], "RMSE / bound");
  EXPECT_EQ(systems.rows[0][11], "1.98");
}

TEST_F(Report, MapsMotionAndNotesStandOnThePage) {
  for (const char* episode : {"e/1", "e/2", "e/3"}) {
    WriteRun(episode, "a", 0.007);
    Write(std::string(episode) + "/a_map_quality.json",
          R"({"surface_error_m": {"mean": 0.004, "p95": 0.011}, "wall_thickness_m": {"median": 0.0123},
              "completeness": [{"within_m": 0.02, "share": 0.5}, {"within_m": 0.05, "share": 0.75},
                               {"within_m": 0.1, "share": 0.99}]})");
  }
  result::Evaluation noted;
  ReadJson(folder_ / "e/2/a_metrics.json", noted);
  noted.add_notes("12 poses in gaps of the reference");
  noted.mutable_calibration()->set_time_offset_s(0.037);
  noted.mutable_calibration()->add_unexcited("lever arm z");
  noted.mutable_timing()->set_latency_p50_ms(1.5);
  noted.mutable_timing()->set_latency_p99_ms(7.5);
  Write("e/2/a_metrics.json", ToJson(noted));
  const Study study = LoadStudy({folder_ / "e"}, {});
  EXPECT_THAT(MapTable(study.groups[0]).rows,
              ElementsAre(ElementsAre("a", "4.00", "11.0", "50.0", "75.0", "99.0", "12.3")));
  const Table motion = MotionTable(study.groups[0]);
  ASSERT_EQ(motion.rows.size(), 8u) << "seven steps and the drift; no KITTI segments on so short a run";
  EXPECT_THAT(motion.rows.back(), Contains("1 m, drift from first to last pose"));
  EXPECT_THAT(PoseErrorTable(study.groups[0], study.groups[0].episodes[0]).rows.back(),
              Contains("drift per m, first to last pose"));
  EXPECT_THAT(TimingTable(study.groups[0], study.groups[0].episodes[1]).rows,
              Contains(ElementsAre("a", "latency, arrival to end", "-", "1.50", "-", "7.50", "-", "-")));
  WritePage(study, {.title = "t", .note = "", .command = "c", .pictures = {}, .file = folder_ / "out.html"});
  EXPECT_THAT(ReadPage(), HasSubstr("2, a: 12 poses in gaps of the reference"));
  EXPECT_THAT(ReadPage(), HasSubstr("2, a: the motion does not excite lever arm z"));
  EXPECT_THAT(ReadPage(), HasSubstr("<figure id=\"group1_timing\"><svg")) << "latency";
  for (const char* name : {"group1_maps.csv", "group1_motion.csv", "inputs.csv"}) {
    EXPECT_TRUE(fs::file_size(folder_ / "out_files" / name) > 0) << name;
  }
}

TEST_F(Report, BadBoundsAreNamed) {
  const auto error_of = [&](const std::string& text) -> std::string {
    Write("bound.csv", text);
    try {
      ReadBound(folder_ / "bound.csv");
    } catch (const CommandError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(error_of(""), HasSubstr("bound.csv: empty"));
  EXPECT_THAT(error_of("utime_us\n1\n"), HasSubstr("bound.csv:1: no column position_m"));
  EXPECT_THAT(error_of("utime_us,position_m\n1,2\n3\n"), HasSubstr("bound.csv:3: too few columns"));
  EXPECT_THAT(error_of("utime_us,position_m\n1,-2\n"), HasSubstr("is no bound"));
  EXPECT_THAT(error_of("utime_us,position_m\n1,nan\n"), HasSubstr("is no bound"));
  EXPECT_EQ(error_of("utime_us,position_m\n"), "");
  EXPECT_TRUE(std::isnan(ReadBound(folder_ / "bound.csv").mean_m));
  EXPECT_THROW(ReadBound(folder_ / "absent.csv"), CommandError);
}

TEST_F(Report, PageHoldsEverything) {
  for (int k = 0; k < 8; ++k) {
    WriteRun("e/" + std::to_string(k), "sdf2d-slam", 0.001 * (k + 1));
    WriteRun("e/" + std::to_string(k), "occupancy2d-slam", 0.02 + 0.001 * k);
  }
  Write("speed.svg", "<svg/>");
  WritePage(LoadStudy({folder_ / "e"}, {}), {.title = "A & B",
                                             .note = "1 < 2",
                                             .command = "evaluator report e",
                                             .pictures = {folder_ / "speed.svg"},
                                             .file = folder_ / "out.html"});
  const std::string page = ReadPage();
  EXPECT_THAT(page, HasSubstr("<h1>A &amp; B</h1>"));
  EXPECT_THAT(page, HasSubstr("<p>1 &lt; 2</p>"));
  EXPECT_THAT(page, HasSubstr("smaller in 8 of 8 episodes"));
  EXPECT_THAT(page, HasSubstr("8 of 8"));
  EXPECT_THAT(page,
              HasSubstr("none (the frames are taken to be the same), across gaps of up to 0.3 s, time offset 0 s"));
  EXPECT_THAT(page, HasSubstr("evaluator &lt;e/3&gt;"));
  EXPECT_THAT(page, HasSubstr("cell_m: 0.05"));
  EXPECT_THAT(page, HasSubstr(Sha256(ReadFile(folder_ / "e/3/sdf2d-slam_metrics.json"))));
  EXPECT_THAT(page, HasSubstr("<figure id=\"group1_boxes\"><svg"));
  EXPECT_THAT(page, HasSubstr("<figure id=\"group1_histogram\"><svg"));
  EXPECT_THAT(page, HasSubstr("<figure id=\"group1_episode1_trajectory\"><svg"));
  EXPECT_THAT(page, HasSubstr("<figure id=\"group1_episode2_error\"><svg"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("data:image/svg+xml;base64," + Base64("<svg/>")));
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(https?:|/|\\.)"))) << "needs nothing but itself";
  for (const char* name :
       {"group1_boxes.svg", "group1_boxes.pdf", "group1_systems.csv", "group1_episodes.csv", "figures.gp"}) {
    EXPECT_TRUE(fs::file_size(folder_ / "out_files" / name) > 0) << name;
  }
  std::vector<std::string> ids;
  const std::regex id("[ \n]id=['\"]([^'\"]+)");
  for (std::sregex_iterator m(page.begin(), page.end(), id), end; m != end; ++m) ids.push_back((*m)[1]);
  std::ranges::sort(ids);
  EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end()) << "identifiers are unique";
}

TEST_F(Report, SameFoldersSamePage) {
  WriteRun("run", "sdf2d-slam", 0.01);
  const auto write = [&] {
    WritePage(LoadStudy({folder_ / "run"}, {}),
              {.title = "t", .note = "", .command = "c", .pictures = {}, .file = folder_ / "out.html"});
    return ReadPage();
  };
  EXPECT_EQ(write(), write());
}

TEST_F(Report, RunWithoutReferenceOrTrajectoryOrMap) {
  result::Evaluation message;
  RelationErrors relations;
  relations.errors.Add({}, {{0.03, 0.0, 0.0}, Eigen::Quaterniond::Identity()});
  AddRelations(relations, message);
  fs::create_directories(folder_ / "run");
  Write("run/x_metrics.json", ToJson(message));
  WritePage(LoadStudy({folder_ / "run"}, {}),
            {.title = "t", .note = "", .command = "c", .pictures = {}, .file = folder_ / "out.html"});
  EXPECT_THAT(ReadPage(), HasSubstr("x: mean error 30.0 mm."));
  EXPECT_THAT(ReadPage(), HasSubstr("<td>relations</td>"));
}

TEST_F(Report, BadInputIsNamed) {
  const auto error_of = [&](const fs::path& path) {
    try {
      LoadStudy({path}, {});
    } catch (const CommandError& error) {
      EXPECT_EQ(error.code(), ExitCode::kBadInput);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of(folder_ / "none"), HasSubstr("none: No such file or directory"));
  EXPECT_THAT(error_of(folder_), HasSubstr("no *_metrics.json in it or below"));
  fs::create_directories(folder_ / "bad");
  Write("bad/x_metrics.json", "{ \"absolute\": 7 }");
  EXPECT_THAT(error_of(folder_ / "bad"), HasSubstr("x_metrics.json: not the result of an evaluation"));
  WriteRun("bad", "x", 0.1);
  Write("bad/x_tum.txt", "rubbish");
  const Study study = LoadStudy({folder_ / "bad"}, {});
  EXPECT_THROW(WritePage(study, {.title = "", .note = "", .command = "", .pictures = {}, .file = folder_ / "out.html"}),
               CommandError);
  EXPECT_NE((FailureRule{.max_mean_m = 0.0}).Validate(), "");
  EXPECT_NE((FailureRule{.min_coverage = 1.1}).Validate(), "");
}

TEST_F(Report, MapIsCutToWhatIsKnown) {
  WriteRun("run", "x", 0.1);
  const MapImage map = LoadMapImage(folder_ / "run/x_map.pgm");
  EXPECT_EQ(map.width, 2);
  EXPECT_EQ(map.height, 1);
  EXPECT_EQ(map.resolution_m, 0.05);
  EXPECT_EQ(map.png.substr(1, 3), "PNG");
  Write("run/cut.pgm", "P5\n400 300\n255\nxx");
  EXPECT_EQ(LoadMapImage(folder_ / "run/cut.pgm").png, "");
  Write("run/text.pgm", "hello");
  EXPECT_EQ(LoadMapImage(folder_ / "run/text.pgm").png, "");
}

TEST(Encodings, KnownValues) {
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Base64("light w"), "bGlnaHQgdw==");
  EXPECT_EQ(Base64(""), "");
}

TEST(Numbers, ThreeDigits) {
  EXPECT_EQ(Number(0.65649), "0.656");
  EXPECT_EQ(Number(5.2349), "5.23");
  EXPECT_EQ(Number(0.0), "0.00");
  EXPECT_EQ(Number(1234.5), "1234");
  EXPECT_EQ(Number(-0.01234), "-0.0123");
  EXPECT_EQ(Number(kInfinity), "failed");
  EXPECT_EQ(Number(std::nan("")), "-");
  EXPECT_EQ(PValue(0.0321), "0.032");
  EXPECT_EQ(PValue(4.2e-10), "4.2e-10");
}

TEST(TextTable, AlignsColumns) {
  const Table table{"t", "Caption.", {"name", "mm"}, {{"a", "12.5"}, {"longer", "3"}}, 1};
  EXPECT_EQ(ToText(table), "Caption.\nname      mm\na       12.5\nlonger     3\n");
}

TEST(Csv, QuotesWhereNeeded) {
  const Table table{"t", "", {"", "b,c"}, {{"say \"hi\"", "2"}}, 1};
  EXPECT_EQ(ToCsv(table), ",\"b,c\"\n\"say \"\"hi\"\"\",2\n");
}

}  // namespace
}  // namespace lcmslam::report
