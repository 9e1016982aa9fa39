#include "db/research/computed_tables.h"

#include <cmath>

#include "db/plain_file.h"

namespace stampede::research {
namespace {

// NaN, where no problem was stored, is no row.
Rows goal_share(const Catalogue& catalogue, std::int64_t episode) {
  Rows rows{{"frame", "share"}, {}, false};
  const EpisodeArrays arrays = catalogue.read_arrays(episode, {.columns = {"progress"}});
  const auto shares = arrays.column("progress").reals();
  for (std::size_t frame = 0; frame < shares.size(); ++frame)
    if (std::isfinite(shares[frame])) rows.rows.push_back({static_cast<std::int64_t>(frame), shares[frame]});
  return rows;
}

}  // namespace

const ComputedTable* find_computed_table(std::string_view name) {
  static const std::vector<ComputedTable> tables = {
      {"goal_share", "How much of the goal holds at each frame, 0 to 1: of a conjunction the share of its parts.",
       goal_share},
  };
  for (const ComputedTable& table : tables)
    if (table.name == name) return &table;
  return nullptr;
}

std::string describe_table(std::string_view name) {
  if (const ComputedTable* computed = find_computed_table(name)) return computed->description;
  const DatasetTable* table = find_dataset_table(name);
  return table ? table->description : "";
}

}  // namespace stampede::research
