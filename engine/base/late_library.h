// Shared libraries of the system that are loaded when they are first used: most commands need none of them.
#pragma once

#include <string>

namespace stampede {

// Lifetime: stays loaded until the process ends. Threads: any.
class LateLibrary {
 public:
  // `file` as the loader finds it (`libz.so.1`), `what` for people (`films`), `cure` the package that has it.
  // Throws Error when it cannot be loaded.
  LateLibrary(const std::string& file, const std::string& what, const std::string& cure);

  // Sets a pointer to the function of this name. Throws Error when the library has none.
  template <typename Function>
  void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(address_of(name));
  }

 private:
  void* address_of(const char* name) const;

  std::string file_, what_, cure_;
  void* handle_ = nullptr;
};

}  // namespace stampede
