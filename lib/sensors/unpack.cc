#include "sensors/unpack.h"

#include <algorithm>
#include <array>
#include <memory>

#include <bzlib.h>
#include <lz4frame.h>

#include "sensors/bad_input.h"

namespace lcmslam {
namespace {

constexpr size_t kStepBytes = size_t{1} << 16;

[[noreturn]] void FailDamaged() { throw BadInput("compressed data is damaged"); }

void Append(std::vector<uint8_t>& unpacked, const uint8_t* bytes, size_t count, size_t size) {
  if (count > size - unpacked.size()) throw BadInput("compressed data is longer than it says");
  unpacked.insert(unpacked.end(), bytes, bytes + count);
}

void RequireSize(const std::vector<uint8_t>& unpacked, size_t size) {
  if (unpacked.size() != size) throw BadInput("compressed data is shorter than it says");
}

}  // namespace

std::vector<uint8_t> UnpackBzip2(std::span<const uint8_t> packed, size_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  stream.next_in = reinterpret_cast<char*>(const_cast<uint8_t*>(packed.data()));
  stream.avail_in = static_cast<unsigned>(packed.size());
  std::vector<uint8_t> unpacked;
  std::array<uint8_t, kStepBytes> step;
  for (int status = BZ_OK; status != BZ_STREAM_END;) {
    stream.next_out = reinterpret_cast<char*>(step.data());
    stream.avail_out = step.size();
    status = BZ2_bzDecompress(&stream);
    const size_t count = step.size() - stream.avail_out;
    if (status != BZ_OK && status != BZ_STREAM_END) FailDamaged();
    if (status == BZ_OK && count == 0 && stream.avail_in == 0) FailDamaged();  // cut off
    Append(unpacked, step.data(), count, size);
  }
  RequireSize(unpacked, size);
  return unpacked;
}

std::vector<uint8_t> UnpackLz4(std::span<const uint8_t> packed, size_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> end(context, LZ4F_freeDecompressionContext);
  std::vector<uint8_t> unpacked;
  std::array<uint8_t, kStepBytes> step;
  for (size_t hint = 1; hint != 0;) {  // 0: the frame is complete
    size_t out_bytes = step.size();
    size_t in_bytes = packed.size();
    hint = LZ4F_decompress(context, step.data(), &out_bytes, packed.data(), &in_bytes, nullptr);
    if (LZ4F_isError(hint) != 0) FailDamaged();
    if (hint != 0 && out_bytes == 0 && in_bytes == 0) FailDamaged();  // cut off
    Append(unpacked, step.data(), out_bytes, size);
    packed = packed.subspan(in_bytes);
  }
  RequireSize(unpacked, size);
  return unpacked;
}

}  // namespace lcmslam
