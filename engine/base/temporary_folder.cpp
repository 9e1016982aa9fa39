#include "engine/base/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "engine/base/error.h"

namespace stampede {

TemporaryFolder::TemporaryFolder() {
  const char* asked = std::getenv("TMPDIR");
  std::string name = std::string(asked == nullptr || *asked == '\0' ? "/tmp" : asked) + "/stampede_XXXXXX";
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
