// Catalogues and episodes as arrays.
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <stampede/catalogue_reader.h>

#include <memory>

#include "convert.h"
#include "interruptible.h"

namespace stampede::python {
namespace {

using namespace nb::literals;

// Keeps the arrays alive while numpy looks at them.
nb::capsule owner_of(const SharedArrays& shared) {
  return nb::capsule(new SharedArrays(shared), [](void* held) noexcept { delete static_cast<SharedArrays*>(held); });
}

NumpyArray view_of(const SharedArrays& shared, const ArrayColumn& column) {
  const nb::capsule owner = owner_of(shared);
  return std::visit(
      [&](const auto& values) -> NumpyArray {
        using Value = typename std::remove_cvref_t<decltype(values)>::value_type;
        if constexpr (std::is_same_v<Value, std::uint8_t>) {
          return numpy_view<Value, bool>(values.data(), column.shape, owner);
        } else {
          return numpy_view(values.data(), column.shape, owner);
        }
      },
      column.data);
}

struct PyColumn {
  SharedArrays shared;
  const ArrayColumn* column;
};

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string text;
  for (const std::int64_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text;
}

PyColumn column_of(const SharedArrays& self, const std::string& name) { return {self, &self.arrays->column(name)}; }

NamedArrays picture_of(CameraPicture picture) {
  NamedArrays result;
  const std::vector<std::int64_t> shape = {picture.height, picture.width};
  if (!picture.rgb.empty()) result["rgb"] = numpy_array(std::move(picture.rgb), {shape[0], shape[1], 3});
  if (!picture.depth.empty()) result["depth"] = numpy_array(std::move(picture.depth), shape);
  if (!picture.instance.empty()) result["mask"] = numpy_array(std::move(picture.instance), shape);
  if (!picture.semantic.empty()) result["semantic_mask"] = numpy_array(std::move(picture.semantic), shape);
  const std::vector<double> intrinsics = {
      picture.focal_x, 0, picture.centre_x, 0, picture.focal_y, picture.centre_y, 0, 0, 1};
  result["intrinsics"] = numpy_array(intrinsics, {3, 3});
  result["extrinsics"] =
      numpy_array(std::vector<double>(picture.world_from_camera.begin(), picture.world_from_camera.end()), {4, 4});
  return result;
}

nb::typed<nb::tuple, std::vector<std::string>, nb::typed<nb::list, nb::tuple>> answer_of(const Rows& rows) {
  return nb::make_tuple(rows.columns, rows_of(rows));
}

// A catalogue as Python has it: a file and a thread that draws are in it.
struct PyReader : Owned<CatalogueReader> {
  explicit PyReader(const std::filesystem::path& file) : PyReader(std::vector<std::filesystem::path>{file}) {}
  explicit PyReader(const std::vector<std::filesystem::path>& files) : Owned("Catalogue", Turn::Others::wait, files) {
    turn.stay_in_this_process();
  }
};

void bind_columns(nb::module_& module) {
  nb::class_<PyColumn>(module, "Column", "One array of an episode, with what it means.")
      .def_prop_ro("name", [](const PyColumn& c) { return c.column->name; })
      .def_prop_ro(
          "unit", [](const PyColumn& c) { return c.column->unit; }, "`m, 1` for a pose: metres, a quaternion")
      .def_prop_ro(
          "frame", [](const PyColumn& c) { return c.column->frame; }, "of reference; empty: none")
      .def_prop_ro(
          "rate_hz", [](const PyColumn& c) { return c.column->rate_hz; }, "of the rows; 0: a constant")
      .def_prop_ro(
          "labels", [](const PyColumn& c) { return c.column->labels; }, "of the last axis")
      .def_prop_ro(
          "values", [](const PyColumn& c) { return view_of(c.shared, *c.column); },
          "numpy array without a copy, read-only; a row a frame")
      .def("__repr__", [](const PyColumn& c) {
        return "Column('" + c.column->name + "', " + shape_text(c.column->shape) +
               (c.column->unit.empty() ? "" : ", " + c.column->unit) + ")";
      });
  nb::class_<ArraySegment>(module, "Segment", "A labelled stretch of an episode.")
      .def_ro("id", &ArraySegment::id)
      .def_ro("parent", &ArraySegment::parent, "-1: none")
      .def_ro("kind", &ArraySegment::kind, "subgoal, skill or motion")
      .def_ro("name", &ArraySegment::name)
      .def_ro("case_name", &ArraySegment::case_name)
      .def_ro("arguments", &ArraySegment::arguments)
      .def_ro("first_frame", &ArraySegment::first_frame)
      .def_ro("end_frame", &ArraySegment::end_frame, "half-open")
      .def_ro("success", &ArraySegment::success)
      .def_ro("reason", &ArraySegment::reason)
      .def_ro("label", &ArraySegment::label, "`pick up the red block`")
      .def("__repr__", [](const ArraySegment& s) {
        return "Segment(" + s.kind + " '" + (s.label.empty() ? s.name : s.label) + "', frames " +
               std::to_string(s.first_frame) + " to " + std::to_string(s.end_frame) + ")";
      });
  nb::class_<ArrayPictures>(module, "PictureColumn", "What one camera sees at every frame; read or drawn on request.")
      .def_ro("name", &ArrayPictures::name, "`front_rgb`")
      .def_ro("camera", &ArrayPictures::camera)
      .def_ro("type", &ArrayPictures::type, "numpy's: uint8, float32, uint16")
      .def_ro("shape", &ArrayPictures::shape)
      .def_ro("unit", &ArrayPictures::unit)
      .def_ro("stored", &ArrayPictures::stored, "frames whose picture the catalogue keeps")
      .def("__repr__", [](const ArrayPictures& p) {
        return "PictureColumn('" + p.name + "', " + shape_text(p.shape) + " " + p.type + ")";
      });
}

void bind_whole_arrays(nb::module_& module) {
  nb::class_<SharedArrays>(module, "EpisodeArrays", R"(One episode as named numpy arrays: `arrays["joint_positions"]`.

Names, shapes, units and frames of reference: engine/episode/README.md. Memory is shared, read-only.)")
      .def_prop_ro("task", [](const SharedArrays& a) { return a.arrays->task; })
      .def_prop_ro("variation", [](const SharedArrays& a) { return a.arrays->variation; })
      .def_prop_ro("seed", [](const SharedArrays& a) { return a.arrays->seed; })
      .def_prop_ro("frames", [](const SharedArrays& a) { return a.arrays->frames; })
      .def_prop_ro("frame_hz", [](const SharedArrays& a) { return a.arrays->frame_hz; })
      .def_prop_ro(
          "atoms", [](const SharedArrays& a) { return a.arrays->atoms; }, "of `facts` and `known`")
      .def_prop_ro(
          "segments", [](const SharedArrays& a) { return a.arrays->segments; }, "by id")
      .def_prop_ro(
          "skills", [](const SharedArrays& a) { return a.arrays->skills; }, "of `applicable`")
      .def_prop_ro("agent_actions", [](const SharedArrays& a) { return a.arrays->agent_actions; })
      .def_prop_ro(
          "pictures", [](const SharedArrays& a) { return a.arrays->pictures; }, "those that can be drawn")
      .def("column", &column_of, "name"_a, "The array with unit, frame of reference and labels.")
      .def("__getitem__",
           [](const SharedArrays& self, const std::string& name) { return view_of(self, self.arrays->column(name)); })
      .def("__contains__",
           [](const SharedArrays& self, const std::string& name) { return self.arrays->find(name) != nullptr; })
      .def("keys",
           [](const SharedArrays& self) {
             std::vector<std::string> names;
             for (const ArrayColumn& column : self.arrays->columns) names.push_back(column.name);
             return names;
           })
      .def("__len__", [](const SharedArrays& self) { return self.arrays->columns.size(); })
      .def("__repr__",
           [](const SharedArrays& self) {
             const EpisodeArrays& a = *self.arrays;
             return "EpisodeArrays(" + a.task + (a.variation.empty() ? "" : " " + a.variation) + ", " +
                    std::to_string(a.frames) + " frames, " + std::to_string(a.columns.size()) + " columns)";
           })
      .def(
          "pose_in",
          [](const SharedArrays& self, const std::string& object, const std::string& reference) {
            ArrayColumn column = self.arrays->pose_in(object, reference);
            return numpy_array(std::get<std::vector<double>>(std::move(column.data)), column.shape);
          },
          "object"_a, "reference"_a, "frames x 7: where an object was as seen from another, or from a camera.");
}

void bind_arrays(nb::module_& module) {
  bind_columns(module);
  bind_whole_arrays(module);
}

void bind_states(nb::module_& module) {
  nb::class_<StateJoint>(module, "StateJoint")
      .def_ro("name", &StateJoint::name)
      .def_ro("position", &StateJoint::position, "rad or m")
      .def_ro("fraction", &StateJoint::fraction, "0 at the lower limit, 1 at the upper");
  nb::class_<StatePose>(module, "StatePose")
      .def_ro("object", &StatePose::object)
      .def_ro("position", &StatePose::position, "m, world")
      .def_ro("orientation_xyzw", &StatePose::orientation_xyzw, "world_from_object");
  nb::class_<StateHand>(module, "StateHand")
      .def_ro("name", &StateHand::name)
      .def_ro("opening_m", &StateHand::opening_m, "between the pads");
  nb::class_<WorldState>(module, "WorldState", "The world in symbols and numbers at one frame.")
      .def_ro("frame", &WorldState::frame)
      .def_ro("time_s", &WorldState::time_s)
      .def_ro("facts", &WorldState::facts)
      .def_ro("joints", &WorldState::joints)
      .def_ro("objects", &WorldState::objects)
      .def_ro("hands", &WorldState::hands)
      .def("__repr__", [](const WorldState& state) {
        return "WorldState(frame " + std::to_string(state.frame) + ", " + std::to_string(state.facts.size()) +
               " facts, " + std::to_string(state.objects.size()) + " objects)";
      });
}

}  // namespace

SharedArrays shared_arrays(EpisodeArrays arrays) { return {std::make_shared<const EpisodeArrays>(std::move(arrays))}; }

NamedArrays picture_object(CameraPicture picture) { return picture_of(std::move(picture)); }

NamedArrays points_object(CameraPoints points) {
  const auto flat = [](const auto& rows) {
    using Value = typename std::remove_cvref_t<decltype(rows)>::value_type::value_type;
    std::vector<Value> values;
    values.reserve(3 * rows.size());
    for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
    return numpy_array(std::move(values), {static_cast<std::int64_t>(rows.size()), 3});
  };
  const auto count = static_cast<std::int64_t>(points.positions.size());
  NamedArrays result;
  result["positions"] = flat(points.positions);
  if (!points.colours.empty()) result["colours"] = flat(points.colours);
  if (!points.instance.empty()) result["mask"] = numpy_array(std::move(points.instance), {count});
  if (!points.semantic.empty()) result["semantic_mask"] = numpy_array(std::move(points.semantic), {count});
  return result;
}

namespace {

void bind_reading(nb::class_<PyReader>& reader) {
  reader.def(nb::init<const std::filesystem::path&>(), "file"_a)
      .def(nb::init<const std::vector<std::filesystem::path>&>(), "files"_a, "Several, read as one.")
      .def(
          "query",
          [](const PyReader& self, const std::string& question, const nb::sequence& parameters,
             std::int64_t most_rows) {
            const Using use(self.turn, "Catalogue.query");
            std::vector<SqlValue> values;
            for (const nb::handle one : parameters) values.push_back(sql_value(one));
            return answer_of(interruptible([&] { return self->query(question, values, most_rows); }));
          },
          "question"_a, "parameters"_a = nb::tuple(), "most_rows"_a = 0,
          "Names of columns, and rows as tuples. most_rows 0: all.")
      .def(
          "arrays",
          [](const PyReader& self, std::int64_t episode, std::vector<std::string> columns) {
            const Using use(self.turn, "Catalogue.arrays");
            return shared_arrays(interruptible([&] { return self->arrays(episode, {columns}); }));
          },
          "episode"_a, "columns"_a = std::vector<std::string>(),
          "Columns or groups by name; none: all but `applicable`.")
      .def(
          "pictures",
          [](const PyReader& self, std::int64_t episode, const std::string& column, std::vector<std::int64_t> frames,
             bool draw, int threads) {
            const Using use(self.turn, "Catalogue.pictures");
            PictureFrames all = interruptible([&] { return self->pictures(episode, column, {frames, draw, threads}); });
            return std::visit([&](auto& values) { return numpy_array(std::move(values), all.shape); }, all.data);
          },
          "episode"_a, "column"_a, "frames"_a, "draw"_a = false, "threads"_a = 1,
          R"(What one camera saw at some frames: frames x height x width (x 3 for colours).

uint8 sRGB, float32 m (0: nothing in range), uint16 ids. Frames that are not stored raise Error, or are drawn now.)");
}

void bind_views(nb::class_<PyReader>& reader) {
  reader
      .def(
          "picture",
          [](const PyReader& self, std::int64_t episode, std::int64_t frame, const std::string& camera, int width,
             int height, bool rgb, bool depth, bool mask, bool semantic_mask, bool shadows) {
            const Using use(self.turn, "Catalogue.picture");
            CameraPicture picture;
            {
              const Released free;
              picture =
                  self->picture(episode, frame, {camera, width, height, rgb, depth, mask, semantic_mask, shadows});
            }
            return picture_of(std::move(picture));
          },
          "episode"_a, "frame"_a, "camera"_a = "front", "width"_a = 0, "height"_a = 0, "rgb"_a = true,
          "depth"_a = false, "mask"_a = false, "semantic_mask"_a = false, "shadows"_a = false,
          "Drawn now, at any size: rgb, depth, mask, semantic_mask, intrinsics, extrinsics (world_from_camera).")
      .def(
          "points",
          [](const PyReader& self, std::int64_t episode, std::int64_t frame, const std::string& camera, int width,
             int height, bool rgb, bool mask, bool semantic_mask) {
            const Using use(self.turn, "Catalogue.points");
            CameraPoints points;
            {
              const Released free;
              points = self->points(episode, frame, {camera, width, height, rgb, true, mask, semantic_mask});
            }
            return points_object(std::move(points));
          },
          "episode"_a, "frame"_a, "camera"_a = "front", "width"_a = 0, "height"_a = 0, "rgb"_a = true, "mask"_a = false,
          "semantic_mask"_a = false,
          "Points that a camera sees, world: positions (n x 3, m), colours, mask, semantic_mask.")
      .def(
          "state",
          [](const PyReader& self, std::int64_t episode, std::int64_t frame) {
            const Using use(self.turn, "Catalogue.state");
            const Released free;
            return self->state(episode, frame);
          },
          "episode"_a, "frame"_a);
}

}  // namespace

void bind_catalogue(nb::module_& module) {
  bind_arrays(module);
  bind_states(module);
  nb::class_<ReadyQuestion>(module, "ReadyQuestion")
      .def_ro("name", &ReadyQuestion::name)
      .def_ro("description", &ReadyQuestion::description)
      .def_ro("sql", &ReadyQuestion::sql);
  module.def("ready_questions", &ready_questions, "Questions that have a name.");
  nb::class_<PyReader> reader(
      module, "CatalogueReader",
      "A catalogue, or several, to be read, in one process; threads that share it wait for each other.");
  bind_reading(reader);
  bind_views(reader);
}

}  // namespace stampede::python
