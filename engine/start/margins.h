// By how much each atom holds, or is from holding, at every frame: the channel `margins`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/record/record.h"
#include "engine/start/predicates.h"
#include "engine/start/world_view.h"

namespace stampede {

class Margins {
 public:
  // Of those of the atoms whose predicate says in which unit it measures. Lifetime: refers to symbols.
  Margins(Symbols& symbols, const std::vector<Fact>& atoms, const WorldView& view);

  bool empty() const { return atoms_.empty(); }
  ChannelRecord channel(double rate_hz) const;  // without readings; components are the atoms as text

  // As the predicates say now, not debounced: not negative where one holds, not positive where it does not; NaN where
  // it gives none. `known`: values read elsewhere, which go first.
  std::vector<double> read(const WorldView& view, const std::map<Fact, Symbols::Value>& known = {}) const;

 private:
  Symbols* symbols_;
  std::vector<Fact> atoms_;
  std::vector<std::string> units_;  // of each
};

}  // namespace stampede
