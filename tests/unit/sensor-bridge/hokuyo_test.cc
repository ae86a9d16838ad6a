// `sensor-bridge hokuyo` against a sensor of our own that speaks SCIP 2 over TCP and over a serial line.

#include <algorithm>
#include <array>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <pty.h>
#include <sys/socket.h>
#include <unistd.h>

#include "bus/messages.h"
#include "support/scip_bytes.h"
#include "unit/sensor-bridge/bridge_runs.h"

namespace lcmslam {
namespace {

// Answers command by command as an URG-04LX does; when asked, gives some scans, and then says that its laser has
// failed.
void ActAsSensor(int descriptor, const std::string& answer_to_scans, int scans) {
  const auto send = [&](const std::string& bytes) {
    EXPECT_EQ(write(descriptor, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  };
  std::string heard;
  std::array<char, 256> buffer;
  for (bool done = false; !done;) {
    const ssize_t length = read(descriptor, buffer.data(), buffer.size());
    if (length <= 0) break;
    heard.append(buffer.data(), static_cast<size_t>(length));
    for (size_t end = heard.find('\n'); end != std::string::npos; end = heard.find('\n')) {
      const std::string command = heard.substr(0, end);
      heard.erase(0, end + 1);
      if (command == "SCIP2.0") send("SCIP2.0\n0Ee\n\n");
      if (command == "QT") send("QT\n00P\n\n");
      if (command == "BM") send("BM\n02R\n\n");
      if (command == "PP") send(kScipUrg04LxParameters);
      if (!command.starts_with("MD")) continue;
      std::string answer = command + "\n" + WithScipSum(answer_to_scans) + "\n";
      for (int i = 0; i < scans; ++i) answer += ScipScan(command, std::vector<int>(682, 1000 + i));
      send(answer + command + "\n" + WithScipSum("50") + "\n");
      done = true;
    }
  }
}

struct HokuyoRun : BridgeRun {
  explicit HokuyoRun(const std::vector<std::string>& arguments) { Run(arguments); }
};

void ExpectThreeScans(const HokuyoRun& run) {
  EXPECT_EQ(run.exit_code, 1) << "the laser failed";
  const std::vector<Event> scans = run.On("LIDAR_2D");
  ASSERT_EQ(scans.size(), 3U);
  const PlanarScan scan = *DecodeScan(scans[2].data);
  ASSERT_EQ(scan.beams.size(), 682U);
  EXPECT_FLOAT_EQ(scan.beams[340].range_m, 1.002F);
  EXPECT_EQ(scan.beams[340].angle_rad, 0.0F);
  EXPECT_EQ(scan.beams.back().dt_us, 0);
  EXPECT_GT(scan.utime, 1'600'000'000'000'000);
}

TEST(Hokuyo, HearsASerialLine) {
  int sensor = -1, host = -1;
  std::array<char, 256> device{};
  ASSERT_EQ(openpty(&sensor, &host, device.data(), nullptr, nullptr), 0);
  std::thread thread(ActAsSensor, sensor, "00", 3);
  const HokuyoRun run({"hokuyo", "--device", device.data()});
  thread.join();
  close(sensor);
  close(host);
  ExpectThreeScans(run);
}

// The port of a sensor that one host can connect to, and its socket.
std::pair<uint16_t, int> Listen() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any_address = reinterpret_cast<sockaddr*>(&address);
  EXPECT_EQ(bind(listener, any_address, size), 0);
  EXPECT_EQ(listen(listener, 1), 0);
  EXPECT_EQ(getsockname(listener, any_address, &size), 0);
  return {ntohs(address.sin_port), listener};
}

HokuyoRun RunOverTcp(const std::string& answer_to_scans, int scans) {
  const auto [port, listener] = Listen();
  int sensor = -1;
  std::thread thread([listener = listener, &sensor, &answer_to_scans, scans] {
    sensor = accept(listener, nullptr, nullptr);
    ActAsSensor(sensor, answer_to_scans, scans);
  });
  HokuyoRun run({"hokuyo", "--host", "127.0.0.1", "--port", std::to_string(port)});
  thread.join();
  close(sensor);
  close(listener);
  return run;
}

TEST(Hokuyo, HearsATcpConnection) { ExpectThreeScans(RunOverTcp("00", 3)); }

TEST(Hokuyo, SaysWhatIsWrong) {
  const HokuyoRun refused = RunOverTcp("10", 0);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_TRUE(refused.On("LIDAR_2D").empty());
  EXPECT_EQ(Bridge({"hokuyo"}), 2);
  EXPECT_EQ(Bridge({"hokuyo", "--host", "a", "--device", "b"}), 2);
  EXPECT_EQ(Bridge({"hokuyo", "--device", "/no/such/device"}), 1);
  EXPECT_EQ(Bridge({"hokuyo", "--device", "/dev/null"}), 1) << "no serial line";
  EXPECT_EQ(Bridge({"hokuyo", "--host", "127.0.0.1", "--port", "1"}), 1);
}

}  // namespace
}  // namespace lcmslam
