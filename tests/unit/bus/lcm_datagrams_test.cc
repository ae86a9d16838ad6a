#include "bus/lcm_datagrams.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gmock/gmock.h>

namespace lcmslam {
namespace {

using Datagram = std::vector<uint8_t>;

void AppendBigEndian(uint32_t value, int bytes, Datagram& datagram) {
  for (int i = bytes - 1; i >= 0; --i) datagram.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

void AppendText(const std::string& text, Datagram& datagram) {
  datagram.insert(datagram.end(), text.begin(), text.end());
}

Datagram Whole(const std::string& channel, const std::vector<uint8_t>& data) {
  Datagram datagram;
  AppendText("LC02", datagram);
  AppendBigEndian(7, 4, datagram);
  AppendText(channel + '\0', datagram);
  datagram.insert(datagram.end(), data.begin(), data.end());
  return datagram;
}

// `data` in fragments of `fragment_bytes`.
std::vector<Datagram> Fragments(uint32_t sequence, const std::string& channel, const std::vector<uint8_t>& data,
                                size_t fragment_bytes) {
  const size_t fragments = (data.size() + fragment_bytes - 1) / fragment_bytes;
  std::vector<Datagram> datagrams;
  for (size_t i = 0; i < fragments; ++i) {
    const size_t begin = i * fragment_bytes, end = std::min(data.size(), begin + fragment_bytes);
    Datagram datagram;
    AppendText("LC03", datagram);
    for (const size_t field : {size_t{sequence}, data.size(), begin})
      AppendBigEndian(static_cast<uint32_t>(field), 4, datagram);
    for (const size_t field : {i, fragments}) AppendBigEndian(static_cast<uint32_t>(field), 2, datagram);
    if (i == 0) AppendText(channel + '\0', datagram);
    datagram.insert(datagram.end(), data.begin() + static_cast<std::ptrdiff_t>(begin),
                    data.begin() + static_cast<std::ptrdiff_t>(end));
    datagrams.push_back(datagram);
  }
  return datagrams;
}

std::vector<uint8_t> Counting(size_t size) {
  std::vector<uint8_t> data(size);
  std::iota(data.begin(), data.end(), uint8_t{1});
  return data;
}

TEST(DatagramAssembler, TakesAMessageOfOneDatagram) {
  for (const size_t size : {size_t{0}, size_t{1}, size_t{60'000}}) {
    DatagramAssembler assembler;
    const auto message = assembler.Add(Whole("POSE", Counting(size)), 1);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->channel, "POSE");
    EXPECT_EQ(message->data, Counting(size));
  }
}

TEST(DatagramAssembler, PutsFragmentsTogetherInAnyOrderAndOnce) {
  const std::vector<uint8_t> data = Counting(9'500);
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Datagram> datagrams = Fragments(seed, "MAP", data, 1'000);
    datagrams.push_back(datagrams[seed % datagrams.size()]);  // repeated
    std::shuffle(datagrams.begin(), datagrams.end(), std::mt19937_64(seed));
    DatagramAssembler assembler;
    int messages = 0;
    for (const Datagram& datagram : datagrams) {
      const auto message = assembler.Add(datagram, 1);
      if (!message) continue;
      ++messages;
      EXPECT_EQ(message->channel, "MAP");
      EXPECT_EQ(message->data, data);
    }
    EXPECT_EQ(messages, 1);
  }
}

TEST(DatagramAssembler, TellsSendersAndSequencesApart) {
  const auto a = Fragments(1, "A", Counting(300), 100), b = Fragments(1, "B", Counting(200), 100);
  const auto c = Fragments(2, "C", Counting(250), 100);
  DatagramAssembler assembler;
  std::vector<std::string> whole;
  for (size_t i = 0; i < 3; ++i) {
    for (const auto& [datagrams, sender] : {std::pair{a, 1U}, {b, 2U}, {c, 1U}}) {
      if (i >= datagrams.size()) continue;
      if (const auto message = assembler.Add(datagrams[i], sender)) whole.push_back(message->channel);
    }
  }
  EXPECT_THAT(whole, testing::ElementsAre("B", "A", "C"));
}

TEST(DatagramAssembler, AMissingFragmentCostsItsMessageOnly) {
  DatagramAssembler assembler;
  int messages = 0;
  for (uint32_t sequence = 0; sequence < 1000; ++sequence) {
    std::vector<Datagram> datagrams = Fragments(sequence, "MAP", Counting(300), 100);
    if (sequence % 2 == 0) datagrams.erase(datagrams.begin() + sequence % 3);
    for (const Datagram& datagram : datagrams) messages += assembler.Add(datagram, 1) ? 1 : 0;
  }
  EXPECT_EQ(messages, 500);
}

TEST(DatagramAssembler, FragmentsThatDisagreeBeginAnew) {
  DatagramAssembler assembler;
  EXPECT_FALSE(assembler.Add(Fragments(1, "OLD", Counting(200), 100)[0], 1));
  const auto datagrams = Fragments(1, "NEW", Counting(400), 100);
  for (size_t i = 0; i < 3; ++i) EXPECT_FALSE(assembler.Add(datagrams[i], 1));
  const auto message = assembler.Add(datagrams[3], 1);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->data, Counting(400));
}

TEST(DatagramAssembler, RefusesWhatIsNotLcm) {
  DatagramAssembler assembler;
  Datagram no_end_of_channel = Whole("POSE", {});
  no_end_of_channel.pop_back();
  Datagram beyond_the_end = Fragments(1, "MAP", Counting(300), 100)[2];
  beyond_the_end[11] = 50;  // the data's size
  Datagram no_such_fragment = Fragments(1, "MAP", Counting(300), 100)[2];
  no_such_fragment[17] = 3;
  Datagram too_large = Fragments(1, "MAP", Counting(300), 100)[1];
  too_large[8] = 0x7f;
  for (const Datagram& datagram : {Datagram{}, Datagram{'L', 'C', '0', '2'}, Datagram(100, 'x'), no_end_of_channel,
                                   beyond_the_end, no_such_fragment, too_large, Whole(std::string(64, 'C'), {})})
    EXPECT_FALSE(assembler.Add(datagram, 1));
}

// A fragment that claims to be the end of 16 MB makes it hold as much, so these would come to 320 MB.
TEST(DatagramAssembler, MutatedDatagramsNeitherCrashItNorFillTheMemory) {
  std::mt19937_64 random(1);
  DatagramAssembler assembler;
  for (uint32_t i = 0; i < 100'000; ++i) {
    Datagram datagram = i % 2 == 0 ? Whole("POSE", Counting(40)) : Fragments(i, "MAP", Counting(300), 100)[i % 3];
    for (int flips = 0; flips < 3; ++flips)
      datagram[random() % std::min<size_t>(datagram.size(), 24)] = random() & 0xff;
    datagram.resize(datagram.size() - random() % 3);
    const auto message = assembler.Add(datagram, i % 5);
    EXPECT_LE(message ? message->data.size() : 0, kMaxMessageBytes);
  }
  for (uint32_t sequence = 0; sequence < 20; ++sequence) {
    Datagram datagram = Fragments(sequence, "MAP", Counting(300), 100)[1];
    for (const size_t field : {8, 12}) datagram[field + 1] = 0xff;  // 16 MB, of which this stands at the end
    EXPECT_FALSE(assembler.Add(datagram, 1));
    EXPECT_LE(assembler.unfinished_bytes(), 2 * kMaxMessageBytes);
  }
}

}  // namespace
}  // namespace lcmslam
