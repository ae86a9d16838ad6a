#include "sensors/udp_capture.h"

#include <array>

#include <fmt/format.h>
#include <pcap/pcap.h>

#include "sensors/bad_input.h"

namespace lcmslam {
namespace {

using Bytes = std::span<const uint8_t>;

constexpr uint16_t kIpv4 = 0x0800;
constexpr uint16_t kVlan = 0x8100;
constexpr uint8_t kUdp = 17;
constexpr size_t kUdpHeaderBytes = 8;

// A 16-bit number in network order; 0 beyond the end.
uint16_t Number16(Bytes bytes, size_t at) {
  return at + 2 > bytes.size() ? uint16_t{0} : static_cast<uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

Bytes Behind(Bytes bytes, size_t count) { return bytes.subspan(std::min(count, bytes.size())); }

// The IPv4 packet of a frame; empty when it holds none.
Bytes IpPacket(Bytes frame, int link_type) {
  size_t type_at = 0, header_bytes = 0;
  switch (link_type) {
    case DLT_RAW:
      return frame;
    case DLT_EN10MB:
      type_at = Number16(frame, 12) == kVlan ? 16 : 12;
      header_bytes = type_at + 2;
      break;
    case DLT_LINUX_SLL:
      type_at = 14;
      header_bytes = 16;
      break;
    case DLT_LINUX_SLL2:
      header_bytes = 20;  // begins with the type
      break;
  }
  return Number16(frame, type_at) == kIpv4 ? Behind(frame, header_bytes) : Bytes();
}

// RFC 791, RFC 768.
std::optional<UdpDatagram> Datagram(Bytes ip) {
  if (ip.size() < 20 || ip[0] >> 4 != 4 || ip[9] != kUdp) return std::nullopt;
  const bool is_fragment = (Number16(ip, 6) & 0x3FFF) != 0;
  if (is_fragment) return std::nullopt;
  const Bytes udp = Behind(ip, size_t{4} * (ip[0] & 0x0F));
  const size_t udp_bytes = Number16(udp, 4);
  if (udp_bytes < kUdpHeaderBytes || udp_bytes > udp.size()) return std::nullopt;
  return UdpDatagram{.source_port = Number16(udp, 0),
                     .destination_port = Number16(udp, 2),
                     .payload = udp.first(udp_bytes).subspan(kUdpHeaderBytes)};
}

bool IsRead(int link_type) {
  return link_type == DLT_RAW || link_type == DLT_EN10MB || link_type == DLT_LINUX_SLL || link_type == DLT_LINUX_SLL2;
}

pcap* Open(const std::filesystem::path& path) {
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  pcap* capture = pcap_open_offline(path.c_str(), error.data());
  if (capture == nullptr) throw BadInput(fmt::format("{}: {}", path.string(), error.data()));
  return capture;
}

}  // namespace

UdpCaptureReader::UdpCaptureReader(const std::filesystem::path& path) : path_(path), capture_(Open(path), pcap_close) {
  const int link_type = pcap_datalink(capture_.get());
  if (!IsRead(link_type))
    throw BadInput(
        fmt::format("{}: frames of link type {}, neither Ethernet, Linux cooked nor raw IP", path.string(), link_type));
}

std::optional<UdpDatagram> UdpCaptureReader::Next() {
  pcap_pkthdr* header = nullptr;
  const uint8_t* data = nullptr;
  int status = 0;
  while ((status = pcap_next_ex(capture_.get(), &header, &data)) == 1) {
    std::optional<UdpDatagram> datagram = Datagram(IpPacket({data, header->caplen}, pcap_datalink(capture_.get())));
    if (!datagram) continue;
    datagram->received_utime = int64_t{header->ts.tv_sec} * 1'000'000 + header->ts.tv_usec;
    return datagram;
  }
  if (status == PCAP_ERROR) throw BadInput(fmt::format("{}: {}", path_.string(), pcap_geterr(capture_.get())));
  return std::nullopt;
}

}  // namespace lcmslam
