#include "sensors/velodyne_payloads.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "sensors/bad_input.h"
#include "sensors/velodyne_packet.h"

namespace lcmslam {
namespace {

// Every block of a bare payload begins like this; no capture does.
constexpr std::string_view kBareStart = "\xFF\xEE";

bool StartsBare(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, kBareStart.size()> start{};
  return file.read(start.data(), start.size()) && std::string_view(start.data(), start.size()) == kBareStart;
}

}  // namespace

VelodynePayloadReader::VelodynePayloadReader(const std::filesystem::path& path, uint16_t port)
    : path_(path), port_(port) {
  if (StartsBare(path)) {
    bare_.open(path, std::ios::binary);
  } else {
    capture_.emplace(path);
  }
}

std::optional<VelodynePayload> VelodynePayloadReader::Next() { return capture_ ? NextCaptured() : NextBare(); }

std::optional<VelodynePayload> VelodynePayloadReader::NextCaptured() {
  while (const std::optional<UdpDatagram> datagram = capture_->Next()) {
    if (datagram->payload.size() != kVelodynePacketBytes) continue;  // position packets, say
    if (port_ != 0 && datagram->destination_port != port_) continue;
    return VelodynePayload{datagram->payload, datagram->received_utime, datagram->destination_port};
  }
  return std::nullopt;
}

std::optional<VelodynePayload> VelodynePayloadReader::NextBare() {
  bare_payload_.resize(kVelodynePacketBytes);
  bare_.read(reinterpret_cast<char*>(bare_payload_.data()), kVelodynePacketBytes);
  if (bare_.gcount() == 0) return std::nullopt;
  if (!bare_) throw BadInput(fmt::format("{}: ends in the middle of a packet", path_.string()));
  return VelodynePayload{bare_payload_, std::nullopt, 0};
}

}  // namespace lcmslam
