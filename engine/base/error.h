// Bad input: where it is, what is wrong with it, and how to cure it.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace stampede {

// Thrown for bad input only; what can happen in a healthy program is a result with a Reason (reason.h).
// `where` is a place a person can open (`tasks/stack.lua:4`, `--workers`), `hint` the cure or empty.
class Error : public std::exception {
 public:
  Error(std::string where, std::string what, std::string hint = {})
      : where_(std::move(where)), message_(std::move(what)), hint_(std::move(hint)) {
    text_ = where_.empty() ? message_ : where_ + ": " + message_;
    if (!hint_.empty()) text_ += "\n    " + hint_;
  }
  const char* what() const noexcept override { return text_.c_str(); }  // where: message, then the hint
  const std::string& where() const { return where_; }
  const std::string& message() const { return message_; }
  const std::string& hint() const { return hint_; }

 private:
  std::string where_, message_, hint_, text_;
};

// A file of the catalogue that cannot be used (exit code 4 of the program).
class CatalogueError : public Error {
 public:
  using Error::Error;
};

}  // namespace stampede
