#include "engine/base/late_library.h"

#include <dlfcn.h>

#include "engine/base/error.h"

namespace stampede {

LateLibrary::LateLibrary(const std::string& file, const std::string& what, const std::string& cure)
    : file_(file), what_(what), cure_(cure), handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    const char* const why = dlerror();
    throw Error(what_, std::string("a library cannot be loaded: ") + (why != nullptr ? why : file_.c_str()), cure_);
  }
}

void* LateLibrary::address_of(const char* name) const {
  void* const address = dlsym(handle_, name);
  if (address == nullptr) throw Error(what_, file_ + " has no " + name, cure_);
  return address;
}

}  // namespace stampede
