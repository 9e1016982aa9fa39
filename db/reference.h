// What the views and their columns mean, as db/README.md says it.
#pragma once

#include <string>
#include <vector>

namespace stampede {

struct ViewColumn {
  std::string name, meaning;
  std::string unit, frame;  // empty: none
  std::string null;         // when it is NULL: `never`, or why
};

struct ViewReference {
  std::string name, description;
  std::vector<ViewColumn> columns;
};

const std::vector<ViewReference>& view_reference();  // by name

// For Datasette, as its metadata.json: what its pages say of the views of a catalogue, which is called `database`
// there.
std::string datasette_metadata(const std::string& database);

}  // namespace stampede
