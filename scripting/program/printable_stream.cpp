#include "scripting/program/printable_stream.h"

#include "engine/base/printable.h"

namespace stampede::program {
namespace {

// Bytes at the end that begin a character of UTF-8 and do not end it.
std::size_t unfinished(std::string_view text) {
  for (std::size_t back = 1; back <= 3 && back <= text.size(); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if (byte < 0x80) return 0;
    if (byte < 0xC0) continue;
    return back < (byte >= 0xF0 ? 4U : byte >= 0xE0 ? 3U : 2U) ? back : 0;
  }
  return 0;
}

}  // namespace

std::streamsize PrintableStream::Buffer::xsputn(const char* text, std::streamsize size) {
  const std::lock_guard lock(mutex_);
  begun_.append(text, static_cast<std::size_t>(size));
  const std::size_t kept = unfinished(begun_);
  to_ << printable(std::string_view(begun_).substr(0, begun_.size() - kept));
  begun_.erase(0, begun_.size() - kept);
  return to_ ? size : 0;
}

PrintableStream::Buffer::int_type PrintableStream::Buffer::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char one = traits_type::to_char_type(c);
  return xsputn(&one, 1) == 1 ? c : traits_type::eof();
}

void PrintableStream::Buffer::end() {
  const std::lock_guard lock(mutex_);
  to_ << printable(begun_);
  begun_.clear();
}

int PrintableStream::Buffer::sync() {
  const std::lock_guard lock(mutex_);
  to_.flush();
  return to_ ? 0 : -1;
}

}  // namespace stampede::program
