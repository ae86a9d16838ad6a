#include "sensors/scip.h"

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "sensors/bad_input.h"
#include "sensors/text_lines.h"

namespace lcmslam {
namespace {

constexpr size_t kLongestReply = 100'000;
constexpr size_t kRangeCharacters = 3;
constexpr int kMaxSteps = 10'000;

// Six bits a character.
char Checksum(std::string_view text) {
  return static_cast<char>((std::accumulate(text.begin(), text.end(), 0) & 0x3F) + 0x30);
}

// Takes the checksum off the end. Before it parameters have a semicolon, which does not count.
bool TakeChecksum(std::string_view& line) {
  if (line.empty()) return false;
  const char sum = line.back();
  line.remove_suffix(1);
  if (sum == Checksum(line)) return true;
  if (!line.ends_with(';')) return false;
  line.remove_suffix(1);
  return sum == Checksum(line);
}

std::optional<ScipReply> ParseReply(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  if (!lines.Next(line)) return std::nullopt;
  ScipReply reply{.command = std::string(line), .status = "", .lines = {}};
  if (!lines.Next(line) || line.size() != 3 || !TakeChecksum(line)) return std::nullopt;
  reply.status = line;
  while (lines.Next(line)) {
    if (!TakeChecksum(line)) return std::nullopt;
    reply.lines.emplace_back(line);
  }
  return reply;
}

}  // namespace

std::optional<ScipReply> ScipReplyReader::Next() {
  for (size_t end = bytes_.find("\n\n"); end != std::string::npos; end = bytes_.find("\n\n")) {
    const std::optional<ScipReply> reply = ParseReply(std::string_view(bytes_).substr(0, end));
    bytes_.erase(0, end + 2);
    if (reply) return reply;
    ++refused_;
  }
  if (bytes_.size() > kLongestReply) {
    bytes_.clear();
    ++refused_;
  }
  return std::nullopt;
}

ScipParameters ParseScipParameters(const ScipReply& reply) {
  std::map<std::string, std::string_view, std::less<>> values;
  for (const std::string& line : reply.lines) {
    const size_t colon = line.find(':');
    if (colon != std::string::npos) values[line.substr(0, colon)] = std::string_view(line).substr(colon + 1);
  }
  const auto number = [&](std::string_view name) {
    const auto value = values.find(name);
    if (value == values.end()) throw BadInput(fmt::format("SCIP parameters without {}", name));
    return ParseNumber<int>(value->second);
  };
  ScipParameters p{.first_step = number("AMIN"),
                   .last_step = number("AMAX"),
                   .front_step = number("AFRT"),
                   .steps_per_turn = number("ARES"),
                   .turn_s = 60.0 / number("SCAN"),
                   .min_range_m = 1e-3 * number("DMIN"),
                   .max_range_m = 1e-3 * number("DMAX")};
  const bool steps_fit = 0 <= p.first_step && p.first_step <= p.last_step && p.last_step < kMaxSteps &&
                         0 < p.steps_per_turn && std::abs(p.front_step) < kMaxSteps;
  if (!steps_fit || !(p.turn_s > 0.0 && p.turn_s <= 60.0)) throw BadInput("SCIP parameters that cannot be");
  return p;
}

std::string ScipScanCommand(const ScipParameters& parameters) {
  return fmt::format("MD{:04}{:04}01000\n", parameters.first_step, parameters.last_step);  // every step, every scan
}

PlanarScan DecodeScipScan(const ScipReply& reply, const ScipParameters& parameters, int64_t utime) {
  std::string characters;
  for (size_t i = 1; i < reply.lines.size(); ++i) characters += reply.lines[i];  // the first is the sensor's clock
  const int steps = parameters.last_step - parameters.first_step + 1;
  if (characters.size() != kRangeCharacters * static_cast<size_t>(steps))
    throw BadInput(fmt::format("SCIP scan of {} characters for {} ranges", characters.size(), steps));
  PlanarScan scan{.utime = utime, .beams = {}};
  for (int i = 0; i < steps; ++i) {
    int range_mm = 0;
    for (const char c :
         std::string_view(characters).substr(kRangeCharacters * static_cast<size_t>(i), kRangeCharacters))
      range_mm = range_mm << 6 | ((c - 0x30) & 0x3F);
    const double range_m = 1e-3 * range_mm;
    const bool seen = range_m >= parameters.min_range_m && range_m <= parameters.max_range_m;
    const double turns =
        static_cast<double>(parameters.first_step + i - parameters.front_step) / parameters.steps_per_turn;
    const double dt_s = parameters.turn_s * (i - (steps - 1)) / parameters.steps_per_turn;
    scan.beams.push_back({.range_m = seen ? static_cast<float>(range_m) : 0.0F,
                          .angle_rad = static_cast<float>(2.0 * std::numbers::pi * turns),
                          .dt_us = static_cast<int32_t>(std::lround(1e6 * dt_s))});
  }
  return scan;
}

}  // namespace lcmslam
