// A main for fuzz targets where there is no libFuzzer: first every input of some corpora, then inputs made from them by
// random changes. The same seed tries the same cases. An input that ends the program is written to stderr.
//   TARGET CASES SEED CORPUS...   where a corpus is a file of which every line is an input in hexadecimal, if its name ends
//                                 in .hex, or is an input itself
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;
constexpr std::size_t kLongest = 600;

Input current;

void write_current(int signal) {
  constexpr char digits[] = "0123456789abcdef";
  for (const std::uint8_t byte : current) {
    const char pair[] = {digits[byte >> 4], digits[byte & 15]};
    if (write(STDERR_FILENO, pair, 2) != 2) break;
  }
  if (write(STDERR_FILENO, "\n", 1) != 1) _exit(2);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void run(Input input) {
  current = std::move(input);
  LLVMFuzzerTestOneInput(current.data(), current.size());
}

std::vector<Input> inputs_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  if (!path.ends_with(".hex")) return {{std::istreambuf_iterator<char>(file), {}}};
  std::vector<Input> inputs;
  for (std::string line; std::getline(file, line);) {
    Input& input = inputs.emplace_back();
    for (std::size_t i = 0; i + 1 < line.size(); i += 2)
      input.push_back(static_cast<std::uint8_t>(std::stoi(line.substr(i, 2), nullptr, 16)));
  }
  return inputs;
}

class Changes {
 public:
  Changes(const std::vector<Input>& corpus, std::uint64_t seed) : corpus_(corpus), random_(seed) {}

  /// One to four changes of an input.
  Input next() {
    Input input = corpus_[below(corpus_.size())];
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(input);
    input.resize(std::min(input.size(), kLongest));
    return input;
  }

 private:
  std::size_t below(std::size_t count) { return count ? random_() % count : 0; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(random_()); }

  void change(Input& input) {
    const std::size_t at = below(input.size());
    const auto place = input.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end_of = [&](std::size_t length) {
      return place + static_cast<std::ptrdiff_t>(std::min(length, input.size() - at));
    };
    switch (input.empty() ? 0 : below(6)) {
      case 0:
        input.insert(place, 1 + below(8), byte());
        return;
      case 1:
        *place ^= static_cast<std::uint8_t>(1 << below(8));
        return;
      case 2:
        *place = byte();
        return;
      case 3:
        input.erase(place, end_of(1 + below(16)));
        return;
      case 4: {
        const Input part(place, end_of(1 + below(32)));
        input.insert(input.begin() + static_cast<std::ptrdiff_t>(below(input.size())), part.begin(),
                     part.end());
        return;
      }
      default: {
        const Input& other = corpus_[below(corpus_.size())];
        input.resize(at);
        input.insert(input.end(), other.begin() + static_cast<std::ptrdiff_t>(below(other.size())),
                     other.end());
      }
    }
  }

  const std::vector<Input>& corpus_;
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "usage: %s CASES SEED CORPUS...\n", argv[0]), 2;
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGTERM}) std::signal(signal, write_current);
  std::vector<Input> corpus;
  for (int i = 3; i < argc; ++i)
    for (Input& input : inputs_of(argv[i])) corpus.push_back(std::move(input));
  for (const Input& input : corpus) run(input);
  const std::uint64_t cases = std::strtoull(argv[1], nullptr, 10);
  Changes changes(corpus, std::strtoull(argv[2], nullptr, 10));
  for (std::uint64_t i = 0; i < cases; ++i) run(changes.next());
  std::printf("%zu inputs and %llu changed ones, no fault\n", corpus.size(),
              static_cast<unsigned long long>(cases));
}
