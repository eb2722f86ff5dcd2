// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Replays the seed corpus and seeded mutations of it through the readers: the short run of ./check.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>
#include <vector>

#include "fuzz/readers.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kLargest = 8192;  // bytes of an input

Bytes read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Makes small changes of the kinds that find most: bytes, tokens of the formats, pieces moved or lost, the
/// halves of two inputs joined.
class Mutator {
 public:
  explicit Mutator(const std::vector<Bytes>& corpus) : corpus_(corpus) {}

  Bytes next() {
    Bytes bytes = corpus_[below(corpus_.size())];
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(bytes);
    bytes.resize(std::min(bytes.size(), kLargest));
    return bytes;
  }

 private:
  static constexpr std::string_view kTokens[] = {",",        ";",
                                                 "\n",       "\r\n",
                                                 "\"",       "\"\"",
                                                 "#",        "-",
                                                 "0",        "1e308",
                                                 "-1e308",   "1e-320",
                                                 "nan",      "inf",
                                                 "1e999",    "\t",
                                                 "=",        "[",
                                                 "]",        "[[",
                                                 "{",        "}",
                                                 "\n----\n", "DATA",
                                                 "UNIT",     "GROUP",
                                                 "HEADING",  "load",
                                                 "unload",   "hold",
                                                 "relax",    "ontlastingstap",
                                                 "true",     "\xEF\xBB\xBF",
                                                 "\xFF",     " "};

  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(generator_);
  }

  void change(Bytes& bytes) {
    const auto at = [&](std::size_t i) { return bytes.begin() + static_cast<std::ptrdiff_t>(i); };
    if (bytes.size() < 2) bytes.resize(2, 0);
    const std::size_t i = 1 + below(bytes.size() - 1);  // the first byte chooses the reader
    const std::size_t length = std::min(1 + below(40), bytes.size() - i);
    switch (below(6)) {
      case 0:
        bytes[i] = static_cast<std::uint8_t>(below(256));
        return;
      case 1:
        bytes[i] = static_cast<std::uint8_t>('0' + below(10));
        return;
      case 2: {
        const std::string_view token = kTokens[below(std::size(kTokens))];
        bytes.insert(at(i), token.begin(), token.end());
        return;
      }
      case 3:
        bytes.erase(at(i), at(i + length));
        return;
      case 4: {
        const Bytes piece(at(i), at(i + length));
        bytes.insert(at(1 + below(bytes.size() - 1)), piece.begin(), piece.end());
        return;
      }
      default: {
        const Bytes& other = corpus_[below(corpus_.size())];
        bytes.erase(at(i), bytes.end());
        bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(below(other.size())),
                     other.end());
      }
    }
  }

  const std::vector<Bytes>& corpus_;
  std::mt19937_64 generator_{20261122};
};

int fail(const Bytes& bytes, const char* what) {
  const char* const file = "readers_finding.bin";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  fmt::print(stderr, "a reader let \"{}\" out; the input is kept as {}\n", what, file);
  return EXIT_FAILURE;
}

}  // namespace

/// Arguments: the folder of the corpus, the number of mutations.
int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: {} CORPUS MUTATIONS\n", argv[0]);
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> corpus;
  for (const auto& file : files) corpus.push_back(read_file(file));
  std::erase_if(corpus, [](const Bytes& bytes) { return bytes.empty(); });
  if (corpus.empty()) {
    fmt::print(stderr, "no input in {}\n", argv[1]);
    return 2;
  }
  Mutator mutator(corpus);
  const long mutations = std::atol(argv[2]);
  long accepted = 0;
  Bytes bytes;
  try {
    for (const Bytes& seed : corpus) {
      bytes = seed;
      // A seed that no reader accepts would leave the fuzzer at the door.
      if (!isotach::fuzz::read_bytes(bytes)) return fail(bytes, "refusal of a seed");
    }
    for (long i = 0; i < mutations; ++i) {
      bytes = mutator.next();
      if (isotach::fuzz::read_bytes(bytes)) ++accepted;
    }
  } catch (const std::exception& error) {
    return fail(bytes, error.what());
  }
  fmt::print("{} seeds, {} mutations of them ({} accepted): no finding\n", corpus.size(), mutations,
             accepted);
  return EXIT_SUCCESS;
}
