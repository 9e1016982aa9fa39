// The .sql files of this room and its README, put into the library when it is built.
#pragma once

#include <string>
#include <vector>

namespace stampede {

struct SqlFile {
  std::string name;  // of the file, without .sql
  std::string text;
};

const std::vector<SqlFile>& embedded_schema();    // the tables, in order of application
const std::vector<SqlFile>& embedded_indexes();   // made when they are missing
const std::vector<SqlFile>& embedded_releases();  // `005`: what the oldest release declared that we read
// `005_to_006`, in order; the first line names the tables it changes
const std::vector<SqlFile>& embedded_migrations();
const std::vector<SqlFile>& embedded_derived();  // what is worked out when an episode is stored
const std::vector<SqlFile>& embedded_views();    // by name; each makes the view of its name
const std::vector<SqlFile>& embedded_queries();  // by name; the first line is a comment that describes it

const std::string& embedded_readme();  // which describes the views

const std::vector<SqlFile>& embedded_datasets();  // by name; each one SELECT, its first line describes the table

}  // namespace stampede
