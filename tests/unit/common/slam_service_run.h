#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <lcmslam/slam_command_t.hpp>

#include "bus/log_reader.h"
#include "bus/log_writer.h"
#include "bus/service.h"
#include "support/temporary_file.h"

namespace lcmslam {

// Runs a SLAM service around a fake algorithm over a log that the test has written.
class SlamServiceRun : public testing::Test {
 protected:
  virtual std::unique_ptr<Service> MakeService(ServiceContext& context) = 0;

  void Write(int64_t utime, const std::string& channel, Bytes data) { input_.Write(utime, channel, data); }
  template <LcmMessage M>
  void Write(int64_t utime, const std::string& channel, const M& message) {
    input_.Write(utime, channel, message);
  }
  void WriteCommand(int64_t utime, int8_t command, double x_m = 0.0, const std::string& service = "") {
    slam_command_t message{};
    message.command = command;
    message.pos[0] = x_m;
    message.quat[0] = 1.0;
    message.service = service;
    Write(utime, "SLAM_COMMAND", message);
  }

  // All events on a channel of the output.
  std::vector<Event> RunAndRead(const std::string& channel) {
    input_.Flush();
    RunOptions run;
    run.log_in = folder_ / "in.lcm";
    run.log_out = folder_ / "out.lcm";
    run.out = folder_;
    ServiceContext context("fake-slam", run);
    RunLogToLog(context, [this](ServiceContext& c) { return MakeService(c); });
    refused_ = context.health().refused();
    missing_ = context.health().missing();
    std::vector<Event> events;
    LogReader reader(run.log_out);
    for (Event event; reader.Next(event);) {
      if (event.channel == channel) events.push_back(event);
    }
    return events;
  }

  const TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
  LogWriter input_{folder_ / "in.lcm"};
  std::vector<std::string> calls_;  // what the algorithm was told
  int64_t refused_ = 0, missing_ = 0;
};

}  // namespace lcmslam
