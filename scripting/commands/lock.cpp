#include "scripting/session/lock.h"

#include <ostream>

#include "scripting/commands/commands.h"

namespace stampede::program {
namespace {

ExitCode do_lock(const Arguments& arguments, Console& console) {
  const std::string file = arguments.text("FILE");
  console.out << to_text(lock_of(Catalogue::open(file), file));
  return kDone;
}

}  // namespace

CommandRow lock_command() {
  return {"lock",
          "Write what a catalogue's episodes are made of, for `make` and `verify`",
          "A lock is JSON of some kilobytes: which episodes, their options, their scripts, the release and a hash of "
          "all content. `stampede make` makes the same catalogue of it, bit for bit, on any machine of the same class "
          "of processor, so that a paper can give its data as one small file. What a policy did, real episodes, and "
          "pictures that were drawn later cannot be made again: a catalogue with such is refused.",
          {{"FILE", "the catalogue", true, false}},
          {},
          {"stampede lock buttons.db > buttons.lock"},
          do_lock};
}

}  // namespace stampede::program
