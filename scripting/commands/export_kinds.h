// What `export` can write; export.cpp is the list.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "db/catalogue.h"
#include "engine/base/output_file.h"
#include "scripting/program/command.h"

namespace stampede::program {

struct ExportJob {
  const Catalogue& catalogue;
  std::vector<std::int64_t> episodes;
  std::filesystem::path folder;
  const Arguments& arguments;
  Console& console;
};

struct ExportCount {
  std::int64_t files = 0;
  std::int64_t left_out = 0;  // episodes or problems; the index and stderr say why
};

using ExportFunction = ExportCount (*)(const ExportJob& job);
ExportCount export_pddl(const ExportJob& job);
ExportCount export_bddl_files(const ExportJob& job);
ExportCount export_recordings(const ExportJob& job);

// With index.csv and index.json in it, by which it is known: they are written when it is opened, and once all is.
OutputFolder indexed_folder(const ExportJob& job, const QueryResult& index);
void write_index(const OutputFolder& folder, const QueryResult& index);

}  // namespace stampede::program
