#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace lcmslam {

// What an URG-04LX answers to PP.
inline constexpr const char* kScipUrg04LxParameters =
    "PP\n00P\nMODL:URG-04LX(Hokuyo Automatic Co.,Ltd.);N\nDMIN:20;4\nDMAX:5600;_\nARES:1024;\\\nAMIN:44;7\nAMAX:725;o\n"
    "AFRT:384;6\nSCAN:600;e\n\n";

inline std::string WithScipSum(const std::string& line) {
  int sum = 0;
  for (const char c : line) sum += c;
  return line + static_cast<char>((sum & 0x3F) + 0x30) + "\n";
}

// Three characters of six bits.
inline std::string ScipRange(int range_mm) {
  std::string text;
  for (const int shift : {12, 6, 0}) text += static_cast<char>(((range_mm >> shift) & 0x3F) + 0x30);
  return text;
}

// A scan: the sensor's clock, then lines of 64 characters.
inline std::string ScipScan(const std::string& command, const std::vector<int>& ranges_mm) {
  constexpr size_t kLine = 64;
  std::string data;
  for (const int range_mm : ranges_mm) data += ScipRange(range_mm);
  std::string reply = command + "\n" + WithScipSum("99") + WithScipSum("0000");
  for (size_t at = 0; at < data.size(); at += kLine) reply += WithScipSum(data.substr(at, kLine));
  return reply + "\n";
}

}  // namespace lcmslam
