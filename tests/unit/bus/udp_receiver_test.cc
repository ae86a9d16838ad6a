#include "bus/udp_receiver.h"

#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "bus/errors.h"

namespace lcmslam {
namespace {

void SendTo(uint16_t port, const std::string& payload) {
  const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const ssize_t sent =
      sendto(sender, payload.data(), payload.size(), 0, reinterpret_cast<sockaddr*>(&address), sizeof address);
  close(sender);
  ASSERT_EQ(sent, static_cast<ssize_t>(payload.size()));
}

TEST(UdpReceiver, HearsDatagramByDatagram) {
  UdpReceiver receiver({});
  ASSERT_NE(receiver.port(), 0);
  EXPECT_FALSE(receiver.Receive(std::chrono::milliseconds(1)));
  for (const std::string payload : {"first", "", "third, longer"}) {
    SendTo(receiver.port(), payload);
    const auto datagram = receiver.Receive(std::chrono::seconds(10));
    ASSERT_TRUE(datagram);
    EXPECT_EQ(std::string(datagram->payload.begin(), datagram->payload.end()), payload);
    EXPECT_GT(datagram->received_utime, 1'600'000'000'000'000);
  }
}

TEST(UdpReceiver, ATakenPortIsAnError) {
  const UdpReceiver first({});
  EXPECT_THROW(UdpReceiver second({.number = first.port()}), CommandError);
}

}  // namespace
}  // namespace lcmslam
