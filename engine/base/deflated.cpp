#include "engine/base/deflated.h"

#include <libdeflate.h>

#include <memory>
#include <new>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr int kSmallest = 12;  // level of libdeflate

}  // namespace

std::string deflated(std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kSmallest), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string result(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  result.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), result.data(), result.size()));
  return result;
}

std::string inflated(std::string_view bytes, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  std::string result(size, '\0');
  if (libdeflate_zlib_decompress(decompressor.get(), bytes.data(), bytes.size(), result.data(), size, nullptr) !=
      LIBDEFLATE_SUCCESS)
    throw Error("deflated text", "the bytes are damaged");
  return result;
}

}  // namespace stampede
