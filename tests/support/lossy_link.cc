// lossy_link INTERFACE INTERFACE LOSS REORDER SEED: a network cable between two Ethernet interfaces that loses and
// reorders packets, each with a probability, the same ones whenever the same packets come; what tc's netem does, for
// kernels without it. Prints READY; at SIGTERM how many packets it carried, lost and held back.
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

volatile std::sig_atomic_t stop_requested = 0;

using Packet = std::vector<uint8_t>;

[[noreturn]] void Fail(const std::string& what) { throw std::runtime_error(what + ": " + std::strerror(errno)); }

// Every packet that arrives at an interface, with the kernel's note (virtio_net_hdr) on the checksum it has yet to fill
// in.
class Plug {
 public:
  explicit Plug(const std::string& interface) : socket_(::socket(AF_PACKET, SOCK_RAW, htons(ETH_P_ALL))) {
    if (socket_ < 0) Fail("packet socket");
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_ALL);
    address.sll_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
    if (address.sll_ifindex == 0 || bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      Fail(interface);
    for (const int option : {PACKET_VNET_HDR, PACKET_IGNORE_OUTGOING}) Set(SOL_PACKET, option, 1);
    Set(SOL_SOCKET, SO_RCVBUF, 16 << 20);  // what net.core.rmem_max leaves of it
  }
  ~Plug() { close(socket_); }
  Plug(const Plug&) = delete;
  Plug& operator=(const Plug&) = delete;

  int socket() const { return socket_; }

  // Empty when none waits.
  Packet Receive() const {
    Packet packet(80'000);
    const ssize_t size = recv(socket_, packet.data(), packet.size(), MSG_DONTWAIT);
    packet.resize(size > 0 ? static_cast<size_t>(size) : 0);
    return packet;
  }
  void Send(const Packet& packet) const {
    if (send(socket_, packet.data(), packet.size(), 0) < 0 && errno != ENOBUFS) Fail("send");
  }

 private:
  void Set(int level, int option, int value) const {
    if (setsockopt(socket_, level, option, &value, sizeof value) != 0) Fail("setsockopt");
  }
  int socket_;
};

// One direction of the cable.
class Lane {
 public:
  Lane(const Plug& from, const Plug& to, double loss, double reorder, uint64_t seed)
      : from_(from), to_(to), loss_(loss), reorder_(reorder), random_(seed) {}

  void Carry() {
    for (Packet packet = from_.Receive(); !packet.empty(); packet = from_.Receive()) {
      if (Happens(loss_)) {
        ++lost_;
      } else if (held_.empty() && Happens(reorder_)) {
        held_ = std::move(packet);  // until the next has passed it
        ++held_back_;
      } else {
        to_.Send(packet);
        ++carried_;
        Release();
      }
    }
  }
  // Nothing has come for a while.
  void Release() {
    if (held_.empty()) return;
    to_.Send(held_);
    ++carried_;
    held_.clear();
  }
  void Print(const char* name) const {
    std::printf("%s: %ld carried, %ld lost, %ld held back\n", name, carried_, lost_, held_back_);
  }

 private:
  bool Happens(double probability) { return static_cast<double>(random_() >> 11) * 0x1p-53 < probability; }

  const Plug &from_, &to_;
  double loss_, reorder_;
  std::mt19937_64 random_;
  Packet held_;
  long carried_ = 0, lost_ = 0, held_back_ = 0;
};

void Run(char** argv) {
  constexpr int kPatienceMs = 5;
  const Plug left(argv[1]), right(argv[2]);
  const double loss = std::atof(argv[3]), reorder = std::atof(argv[4]);
  const uint64_t seed = std::strtoull(argv[5], nullptr, 10);
  Lane there(left, right, loss, reorder, seed), back(right, left, loss, reorder, seed + 1);
  std::fputs("READY\n", stderr);
  std::array<pollfd, 2> waiting{{{left.socket(), POLLIN, 0}, {right.socket(), POLLIN, 0}}};
  while (stop_requested == 0) {
    if (poll(waiting.data(), waiting.size(), kPatienceMs) == 0) {
      there.Release();
      back.Release();
    }
    there.Carry();
    back.Carry();
  }
  there.Print(argv[1]);
  back.Print(argv[2]);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fputs("usage: lossy_link INTERFACE INTERFACE LOSS REORDER SEED\n", stderr);
    return 2;
  }
  std::signal(SIGTERM, [](int) { stop_requested = 1; });
  try {
    Run(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lossy_link: %s\n", error.what());
    return 1;
  }
  return 0;
}
