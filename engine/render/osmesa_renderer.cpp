#include "engine/render/osmesa_renderer.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/render/baked_texture.h"
#include "engine/render/check_views.h"
#include "engine/render/eye.h"

namespace stampede {
namespace {

constexpr std::size_t kKeptTextures = 128;  // between scenes
constexpr std::size_t kKeptLenses = 16;
constexpr std::size_t kFirstIndices = 64 * 1024;  // room in the index buffer

const void* at_byte(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

}  // namespace

OsmesaRenderer::OsmesaRenderer() : gl_(context_.gl()), programs_(gl_), targets_(gl_) {
  gl_.GenBuffers(1, &still_buffer_);
  gl_.GenBuffers(1, &moved_buffer_);
  gl_.GenBuffers(1, &index_buffer_);
  gl_.GenVertexArrays(1, &corners_);
  set_state();
}

void OsmesaRenderer::set_state() {
  gl_.Enable(GL_DEPTH_TEST);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  // Reversed: 1 near, 0 far. A float is finest near 0, where perspective crowds most of what there is to see; with near
  // at 1 cm and far at 4.5 m a plain 24-bit buffer would be off by millimetres.
  gl_.DepthFunc(GL_GREATER);
  gl_.FrontFace(GL_CW);  // rows are drawn from the top, which mirrors everything
  gl_.CullFace(GL_BACK);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.BindVertexArray(corners_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, moved_buffer_);
  constexpr GLsizei kMoved = sizeof(MovedCorner), kStill = sizeof(StillCorner);
  gl_.VertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, kMoved, at_byte(offsetof(MovedCorner, position)));
  gl_.VertexAttribPointer(kNormal, 3, GL_FLOAT, GL_FALSE, kMoved, at_byte(offsetof(MovedCorner, normal)));
  gl_.BindBuffer(GL_ARRAY_BUFFER, still_buffer_);
  gl_.VertexAttribPointer(kColour, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStill, at_byte(offsetof(StillCorner, colour)));
  gl_.VertexAttribIPointer(kIds, 1, GL_UNSIGNED_INT, kStill, at_byte(offsetof(StillCorner, ids)));
  gl_.VertexAttribPointer(kCoordinate, 3, GL_FLOAT, GL_FALSE, kStill, at_byte(offsetof(StillCorner, coordinate)));
  gl_.VertexAttribPointer(kSide, 4, GL_BYTE, GL_TRUE, kStill, at_byte(offsetof(StillCorner, side)));
  for (const GLuint attribute : {kPosition, kNormal, kColour, kIds, kCoordinate, kSide})
    gl_.EnableVertexAttribArray(attribute);
}

void OsmesaRenderer::load(std::shared_ptr<const Scene> scene) {
  if (scene == nullptr) throw Error("renderer", "there is no scene to load");
  if (scene == scene_) return;
  if (!(scene->light.direction.norm() > 0)) throw Error("scene", "its light shines nowhere", "give it a direction");
  context_.make_current();
  SceneDrawing drawing(*scene, tessellations_);  // may throw: then the last scene stays
  scene_ = std::move(scene);
  try {
    load_textures();
  } catch (const Error&) {
    scene_ = nullptr;
    drawing_.reset();
    throw;
  }
  drawing_.emplace(std::move(drawing));
  const auto& still = drawing_->still();
  gl_.BindBuffer(GL_ARRAY_BUFFER, still_buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(still.size() * sizeof(StillCorner)), still.data(),
                 GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ARRAY_BUFFER, moved_buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(still.size() * sizeof(MovedCorner)), nullptr, GL_STREAM_DRAW);
}

void OsmesaRenderer::load_textures() {
  if (pictures_by_content_.size() > kKeptTextures) {
    for (const auto& [content, name] : pictures_by_content_) gl_.DeleteTextures(1, &name);
    pictures_by_content_.clear();
  }
  textures_.clear();
  gl_.ActiveTexture(GL_TEXTURE0 + kPictureUnit);
  for (const auto& [texture_name, texture] : scene_->textures) {
    const Image image = baked(texture, texture_name);
    Hasher hasher;
    hasher.number(image.width).number(image.height).bytes(image.rgba.data(), image.rgba.size());
    GLuint& name = pictures_by_content_[hasher.digest()];
    if (name == 0) {
      gl_.GenTextures(1, &name);
      gl_.BindTexture(GL_TEXTURE_2D, name);
      gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     image.rgba.data());
      gl_.GenerateMipmap(GL_TEXTURE_2D);
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    textures_[texture_name] = name;
  }
}

void OsmesaRenderer::draw(const ScenePoses& poses, std::span<const View> views, const DrawOptions& options,
                          std::vector<Picture>& pictures) {
  if (!drawing_) throw Error("renderer", "there is no scene to draw", "load one first");
  check(options);
  for (const View& view : views) check(view.camera);
  context_.make_current();
  drawing_->move(poses);
  const auto& moved = drawing_->moved();
  gl_.BindBuffer(GL_ARRAY_BUFFER, moved_buffer_);
  if (!moved.empty())
    gl_.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(moved.size() * sizeof(MovedCorner)), moved.data());
  if (options.shadows && options.kinds.rgb && !views.empty()) draw_shadows();
  pictures.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) draw_view(views[i], options, pictures[i]);
}

void OsmesaRenderer::draw_shadows() {
  gl_.ActiveTexture(GL_TEXTURE0 + kShadowUnit);
  if (!shadow_map_) shadow_map_.emplace(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, shadow_map_->texture());
  shadow_view_ = shadow_view(scene_->light, drawing_->balls());
  shadow_map_->bind_target();
  drawing_->select(shadow_view_.eye, false, selection_);
  draw_batches(selection_, shadow_view_.eye, Vector3::Zero(), {});
}

const Lens& OsmesaRenderer::lens_of(const Camera& camera) {
  for (const Lens& lens : lenses_)
    if (lens.fits(camera)) return lens;
  if (lenses_.size() >= kKeptLenses) lenses_.clear();
  return lenses_.emplace_back(camera);
}

void OsmesaRenderer::draw_view(const View& view, const DrawOptions& options, Picture& picture) {
  if (!distorts(view.camera)) return draw_pinhole(view, options, picture);
  const Lens& lens = lens_of(view.camera);
  View wide = view;
  wide.camera = lens.wide();
  wide.camera.near_m = view.camera.near_m;
  wide.camera.far_m = view.camera.far_m;
  draw_pinhole(wide, options, wide_);
  lens.apply(wide_, picture);
}

void OsmesaRenderer::draw_pinhole(const View& view, const DrawOptions& options, Picture& picture) {
  picture.width = view.camera.width;
  picture.height = view.camera.height;
  const PictureKinds& kinds = options.kinds;
  const bool ids = kinds.instance || kinds.semantic;
  const bool apart = kinds.rgb && options.samples > 1;  // then colours are drawn by themselves
  picture.rgb.clear();
  picture.depth.clear();
  picture.instance.clear();
  picture.semantic.clear();
  if ((kinds.rgb && !apart) || ids || kinds.depth) {
    const bool colours = kinds.rgb && !apart;
    draw_pass(view, eye_of(view), {colours, ids, kinds.depth, options.shadows && colours});
    if (colours) read_colours(picture);
    if (ids) read_ids(kinds, picture);
    if (kinds.depth) read_depth(view.camera, picture);
  }
  if (!apart) return;
  const int n = options.samples;
  sums_.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 0);
  for (int i = 0; i < n * n; ++i) {
    draw_pass(view, eye_of(view, (i % n + 0.5) / n - 0.5, (i / n + 0.5) / n - 0.5),
              {true, false, false, options.shadows});
    add_colours(view.camera);
  }
  picture.rgb.resize(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i)
    picture.rgb[i] = static_cast<std::uint8_t>((sums_[i] + n * n / 2) / (n * n));
}

void OsmesaRenderer::draw_pass(const View& view, const Eye& eye, const Pass& pass) {
  targets_.bind({eye.width, eye.height, pass.colours, pass.ids});
  drawing_->select(eye, pass.colours, selection_);
  draw_batches(selection_, eye, view.world_from_camera.translation(), pass);
}

void OsmesaRenderer::use(const Program& program, const Eye& eye, const Vector3& place) const {
  gl_.UseProgram(program.name);
  const Eigen::Matrix4f clip_from_world = eye.clip_from_world.cast<float>();
  gl_.UniformMatrix4fv(program.clip_from_world, 1, GL_FALSE, clip_from_world.data());
  if (program.eye < 0) return;  // no colours
  const Light& light = scene_->light;
  const Eigen::Vector3f from = place.cast<float>(), towards = -light.direction.normalized().cast<float>();
  const Eigen::Vector3f colour = Vector3(light.colour.red, light.colour.green, light.colour.blue).cast<float>();
  const Eigen::Vector3f strengths = Vector3(light.ambient, light.diffuse, light.specular).cast<float>();
  gl_.Uniform3fv(program.eye, 1, from.data());
  gl_.Uniform3fv(program.towards_light, 1, towards.data());
  gl_.Uniform3fv(program.light, 1, colour.data());
  gl_.Uniform3fv(program.strengths, 1, strengths.data());
  if (program.picture >= 0) gl_.Uniform1i(program.picture, kPictureUnit);
  if (program.shadow_map < 0) return;
  const Eigen::Matrix4f shadow_from_world = shadow_view_.shadow_from_world.cast<float>();
  gl_.UniformMatrix4fv(program.shadow_from_world, 1, GL_FALSE, shadow_from_world.data());
  gl_.Uniform1f(program.shadow_texel, static_cast<float>(shadow_view_.texel_m));
  gl_.Uniform1i(program.shadow_map, kShadowUnit);
}

void OsmesaRenderer::draw_batches(const Selection& selection, const Eye& eye, const Vector3& place, const Pass& pass) {
  if (selection.indices.empty()) return;
  if (selection.indices.size() > index_capacity_) {
    index_capacity_ = std::max({kFirstIndices, selection.indices.size(), 2 * index_capacity_});
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(index_capacity_ * sizeof(std::uint32_t)), nullptr,
                   GL_STREAM_DRAW);
  }
  gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0,
                    static_cast<GLsizeiptr>(selection.indices.size() * sizeof(std::uint32_t)),
                    selection.indices.data());
  const Program* used = nullptr;
  bool translucent = false;
  for (const Batch& batch : selection.batches) {
    const bool textured = pass.colours && !batch.texture.empty();
    const Program& program = programs_.get({pass.colours, pass.ids, textured, pass.shadows});
    if (&program != used) use(program, eye, place);
    used = &program;
    if (textured) {
      gl_.ActiveTexture(GL_TEXTURE0 + kPictureUnit);
      gl_.BindTexture(GL_TEXTURE_2D, textures_.at(batch.texture));
    }
    if (batch.translucent && !translucent) {  // behind opaque things; seen in colours alone
      gl_.Enablei(GL_BLEND, 0);
      gl_.ColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      gl_.DepthMask(GL_FALSE);
      translucent = true;
    }
    if (batch.two_sided)
      gl_.Disable(GL_CULL_FACE);
    else
      gl_.Enable(GL_CULL_FACE);
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.count), GL_UNSIGNED_INT,
                     at_byte(batch.first * sizeof(std::uint32_t)));
  }
  if (!translucent) return;
  gl_.Disablei(GL_BLEND, 0);
  gl_.ColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.DepthMask(GL_TRUE);
}

void OsmesaRenderer::read_colours(Picture& picture) {
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  words_.resize(count);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE, words_.data());
  picture.rgb.resize(3 * count);
  std::uint8_t* out = picture.rgb.data();
  for (const std::uint32_t word : words_) {
    out[0] = static_cast<std::uint8_t>(word);
    out[1] = static_cast<std::uint8_t>(word >> 8);
    out[2] = static_cast<std::uint8_t>(word >> 16);
    out += 3;
  }
}

void OsmesaRenderer::add_colours(const Camera& camera) {
  const std::size_t count = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  words_.resize(count);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, camera.width, camera.height, GL_RGBA, GL_UNSIGNED_BYTE, words_.data());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sums_[3 * i + k] = static_cast<std::uint16_t>(sums_[3 * i + k] + (words_[i] >> (8 * k) & 255));
}

void OsmesaRenderer::read_ids(const PictureKinds& kinds, Picture& picture) {
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  words_.resize(count);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, 0, picture.width, picture.height, GL_RED_INTEGER, GL_UNSIGNED_INT, words_.data());
  if (kinds.instance) picture.instance.resize(count);
  if (kinds.semantic) picture.semantic.resize(count);
  for (std::size_t i = 0; i < picture.instance.size(); ++i) picture.instance[i] = static_cast<std::uint16_t>(words_[i]);
  for (std::size_t i = 0; i < picture.semantic.size(); ++i)
    picture.semantic[i] = static_cast<std::uint16_t>(words_[i] >> 16);
}

void OsmesaRenderer::read_depth(const Camera& camera, Picture& picture) {
  picture.depth.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  gl_.ReadPixels(0, 0, picture.width, picture.height, GL_DEPTH_COMPONENT, GL_FLOAT, picture.depth.data());
  const auto product = static_cast<float>(camera.near_m * camera.far_m);
  const auto range = static_cast<float>(camera.far_m - camera.near_m), near = static_cast<float>(camera.near_m);
  for (float& depth : picture.depth) depth = depth > 0 ? product / (depth * range + near) : 0;
}

}  // namespace stampede
