#include "sensors/velodyne_reader.h"

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

VelodyneReader::VelodyneReader(const std::filesystem::path& path, const VelodyneReaderOptions& options)
    : path_(path), options_(options) {
  if (StartsBare(path)) {
    bare_.open(path, std::ios::binary);
  } else {
    capture_.emplace(path);
  }
}

std::optional<Sweep> VelodyneReader::Next() {
  while (ready_.empty()) {
    const std::optional<Payload> payload = NextPayload();
    if (!payload) return std::nullopt;
    try {
      const VelodynePacket packet = DecodeVelodynePacket(payload->bytes);
      const int64_t received_utime = payload->received_utime.value_or(packet.stamp_us);
      for (Sweep& sweep : assembler_.Add(packet, received_utime)) ready_.push_back(std::move(sweep));
      ++packets_;
    } catch (const BadInput&) {
      ++refused_;
    }
  }
  Sweep sweep = std::move(ready_.front());
  ready_.pop_front();
  return sweep;
}

std::optional<VelodyneReader::Payload> VelodyneReader::NextPayload() { return capture_ ? NextCaptured() : NextBare(); }

std::optional<VelodyneReader::Payload> VelodyneReader::NextCaptured() {
  while (const std::optional<UdpDatagram> datagram = capture_->Next()) {
    if (datagram->payload.size() != kVelodynePacketBytes) continue;  // position packets, say
    if (options_.port != 0 && datagram->destination_port != options_.port) continue;
    return Payload{datagram->payload, datagram->received_utime};
  }
  return std::nullopt;
}

std::optional<VelodyneReader::Payload> VelodyneReader::NextBare() {
  bare_payload_.resize(kVelodynePacketBytes);
  bare_.read(reinterpret_cast<char*>(bare_payload_.data()), kVelodynePacketBytes);
  if (bare_.gcount() == 0) return std::nullopt;
  if (!bare_) throw BadInput(fmt::format("{}: ends in the middle of a packet", path_.string()));
  return Payload{bare_payload_, std::nullopt};
}

}  // namespace lcmslam
