// Mesh files are read in a child process, once each; inside this folder.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/file_scope.h"
#include "engine/geometry/transform.h"

namespace stampede {

using Companions = std::vector<std::filesystem::path>;  // files that a mesh file names: materials, pictures, buffers

// What `read` returns, from a child process with limits. A file whose content, and that of its companions, has been
// read before in this process is not read again. `question` is what is read of it.
// `read` adds the companions that it opens. Any thread. Throws Error with the file, the reason and the cure.
std::shared_ptr<const std::string> read_carefully(const std::filesystem::path& file, const std::string& question,
                                                  const FileScope& scope,
                                                  const std::function<std::string(Companions& companions)>& read);

// The exact digits of a scale, for a question.
std::string exact(const Vector3& scale);

}  // namespace stampede
