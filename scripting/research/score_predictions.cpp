// Where things will be against where they were.
#include <cmath>

#include "scripting/research/frame_answers.h"
#include "scripting/research/scorers.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kPredictedEvery = 40;  // frames

}  // namespace

std::vector<Figure> score_predictions(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  const Places places = places_of(job, "object");
  constexpr double kMoved = 0.002;  // m: what rests jitters by less
  std::vector<Figure> figures;
  for (const std::int64_t horizon : {1, 5, 20})
    for (const auto& [table, name] : {std::pair{"hands", "hand"}, {"poses", "thing"}}) {
      Mean error, still;
      const Rows rows =
          job.hidden.query(std::string("SELECT a.episode, a.frame, a.object, a.x, a.y, a.z, b.x AS bx, b.y AS by, "
                                       "b.z AS bz FROM ") +
                               table + " a JOIN " + table +
                               " b ON b.episode = a.episode AND b.object = a.object AND b.frame = a.frame - ?1 "
                               "WHERE a.frame % ?2 = ?1 ORDER BY a.episode, a.frame, a.object",
                           {horizon, kPredictedEvery});
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t row =
            row_about(job, places, {rows.integer(i, "episode"), rows.integer(i, "frame"), rows.text(i, "object")});
        const auto distance = [&](const Rows& from, std::size_t j, const char* x, const char* y, const char* z) {
          return std::hypot(rows.real(i, "x") - from.real(j, x), rows.real(i, "y") - from.real(j, y),
                            rows.real(i, "z") - from.real(j, z));
        };
        const double moved = distance(rows, i, "bx", "by", "bz");
        if (std::string(table) == "poses" && moved < kMoved) continue;
        error.add(distance(job.answers.rows, row, "x", "y", "z")), still.add(moved);
      }
      const std::string after = "_" + std::to_string(horizon);
      const std::string words = std::string(name) + "s " + std::to_string(horizon) + " frames on";
      figures.push_back({name + std::string("_error") + after, error.value(), "mean error of " + words + ", m", false});
      if (still.sum > 0)
        figures.push_back({name + std::string("_relative") + after, error.sum / still.sum,
                           "the same by that of saying that nothing moves", false});
    }
  return figures;
}

}  // namespace stampede::research
