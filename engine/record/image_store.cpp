#include <cstdio>

#include "engine/base/error.h"
#include "engine/base/ordered_work.h"
#include "engine/record/observation.h"

namespace stampede {
namespace {

constexpr std::size_t kInMemory = 8'000'000;  // bytes; an episode of five cameras at its keyframes stays below

[[noreturn]] void disk_failed() {
  throw Error("images", "the temporary file for pictures cannot be written", "free space in /tmp, or set TMPDIR");
}

}  // namespace

struct ImageStore::Impl {
  struct Place {
    std::int64_t begin = 0;
    std::size_t size = 0;
    std::function<std::vector<std::uint8_t>()> make = {};
  };
  ~Impl() {
    if (file != nullptr) std::fclose(file);
  }
  void spill() {
    if (file == nullptr) file = std::tmpfile();  // has no name: it is gone with the process
    if (file == nullptr || std::fseek(file, 0, SEEK_END) != 0 ||
        std::fwrite(memory.data(), 1, memory.size(), file) != memory.size() || std::fflush(file) != 0)
      disk_failed();
    in_file += static_cast<std::int64_t>(memory.size());
    memory.clear();
  }
  std::vector<ImageRecord> records;
  std::vector<Place> places;
  std::vector<std::uint8_t> memory;  // what lies behind the file's end
  std::FILE* file = nullptr;
  std::int64_t in_file = 0;
  int makers = 1;
};

ImageStore::ImageStore() : impl_(std::make_unique<Impl>()) {}
ImageStore::~ImageStore() = default;

void ImageStore::append(ImageRecord image, const std::vector<std::uint8_t>& bytes) {
  if (impl_->memory.size() + bytes.size() > kInMemory) impl_->spill();
  impl_->places.push_back({impl_->in_file + static_cast<std::int64_t>(impl_->memory.size()), bytes.size(), {}});
  impl_->memory.insert(impl_->memory.end(), bytes.begin(), bytes.end());
  impl_->records.push_back(std::move(image));
}

void ImageStore::append_made(ImageRecord image, std::function<std::vector<std::uint8_t>()> make) {
  impl_->places.push_back({0, 0, std::move(make)});
  impl_->records.push_back(std::move(image));
}

std::size_t ImageStore::count() const { return impl_->records.size(); }
std::int64_t ImageStore::bytes() const { return impl_->in_file + static_cast<std::int64_t>(impl_->memory.size()); }
const ImageRecord& ImageStore::record(std::size_t index) const { return impl_->records.at(index); }

std::vector<std::uint8_t> ImageStore::read(std::size_t index) const {
  const Impl::Place& place = impl_->places.at(index);
  if (place.make) return place.make();
  std::vector<std::uint8_t> bytes(place.size);
  if (place.begin >= impl_->in_file) {
    const auto first = impl_->memory.begin() + (place.begin - impl_->in_file);
    std::copy(first, first + static_cast<std::ptrdiff_t>(place.size), bytes.begin());
  } else if (std::fseek(impl_->file, static_cast<long>(place.begin), SEEK_SET) != 0 ||
             std::fread(bytes.data(), 1, bytes.size(), impl_->file) != bytes.size()) {
    disk_failed();
  }
  return bytes;
}

void ImageStore::read_all(const Take& take) const {
  in_order(
      count(), {impl_->makers}, [] { return 0; },
      [&](int, std::size_t i) { return impl_->places[i].make ? impl_->places[i].make() : std::vector<std::uint8_t>(); },
      [&](std::size_t i, std::vector<std::uint8_t> made) { take(record(i), impl_->places[i].make ? made : read(i)); });
}

void ImageStore::set_makers(int threads) { impl_->makers = threads; }

}  // namespace stampede
