// Which episodes are for training, validation and test.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "db/catalogue.h"

namespace stampede::research {

// What `--split` says. The text is canonical: it is part of the data set's identity.
struct SplitRule {
  enum class Kind { seeds, axis, object, task, skill_pairs, axis_pairs };
  Kind kind = Kind::seeds;
  std::string axis = {}, other_axis = {};
  std::vector<std::string> values = {};  // held out
  std::string text() const;
};
// `seeds`, `colour=red,blue`, `object=cube`, `task=stack_blocks,push_buttons`, `composition` (pairs of consecutive
// skills), `composition=colour+height`. Throws Error for what is none of these.
SplitRule split_rule(std::string_view text);

struct SplitEpisode {
  std::int64_t id = 0;
  std::string key, task, catalogue_split;
  std::map<std::string, std::string> axes;
  std::set<std::string> classes;    // of its objects
  std::vector<std::string> skills;  // in order
};
// Those with frames; `where`: a condition over columns of view episodes, empty: none. Throws Error for one that is no
// SQL.
std::vector<SplitEpisode> episodes_to_split(const Catalogue& catalogue, bool demos_only, const std::string& where);

// What was kept out of training, for the hidden part.
struct HeldOut {
  std::string kind, first, second;
};
struct Split {
  std::map<std::int64_t, std::string> of;  // by id: train, validation or test
  std::vector<HeldOut> held_out;
};
// Seeds: of each task's episodes 70 in a hundred train, 15 validate and 15 test, chosen by their keys; where the
// catalogue itself has test seeds, those test. Otherwise what holds a held-out value tests, and of the rest 85 in a
// hundred train. Throws Error where nothing would be left to train on or to test.
Split split_episodes(const std::vector<SplitEpisode>& episodes, const SplitRule& rule);

}  // namespace stampede::research
