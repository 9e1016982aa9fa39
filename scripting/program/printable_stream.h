// A stream to people: text of scripts, files, programs and models reaches no terminal as it is.
#pragma once

#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>

namespace stampede::program {

// Passes on what printable() makes of what is written to it. From any thread, piece by piece.
class PrintableStream : public std::ostream {
 public:
  explicit PrintableStream(std::ostream& to) : std::ostream(nullptr), buffer_(to) { rdbuf(&buffer_); }
  ~PrintableStream() override { buffer_.end(); }
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::ostream& to) : to_(to) {}
    void end();  // what was begun, and never ended

   protected:
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int_type overflow(int_type c) override;
    int sync() override;

   private:
    std::ostream& to_;
    std::mutex mutex_;
    std::string begun_;  // of a character whose other bytes are still to come
  };
  Buffer buffer_;
};

}  // namespace stampede::program
