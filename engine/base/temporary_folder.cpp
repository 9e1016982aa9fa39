#include "engine/base/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "engine/base/error.h"

namespace stampede {

namespace {

std::string usual_place() {
  const char* asked = std::getenv("TMPDIR");
  return asked == nullptr || *asked == '\0' ? "/tmp" : asked;
}

}  // namespace

TemporaryFolder::TemporaryFolder() : TemporaryFolder(usual_place()) {}

TemporaryFolder::TemporaryFolder(const std::filesystem::path& where) {
  std::string name = where.string() + "/stampede_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(name, std::string("a temporary folder cannot be made: ") + std::strerror(errno),
                "set TMPDIR to a folder that can be written");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace stampede
