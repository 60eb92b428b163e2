// SPDX-License-Identifier: MIT
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "policy/iterate.hpp"
#include "policy/optimal.hpp"
#include "policy/svm.hpp"
#include "workload.hpp"

namespace fragmotion::benchmarks {
namespace {

template <typename T>
std::string type_code() {
  return std::string(std::is_floating_point_v<T> ? "<f" : "<i") + std::to_string(sizeof(T));
}

// NumPy's format, version 1.0: magic, length of the header, header padded with spaces to a multiple of 64.
std::string npy_header(const std::string& type, const std::vector<std::size_t>& shape) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const std::size_t length : shape) header += std::to_string(length) + ",";
  header += "), }";
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  const std::string length{static_cast<char>(header.size() % 256), static_cast<char>(header.size() / 256)};
  return std::string("\x93NUMPY\x01\x00", 8) + length + header;
}

class Writer {
 public:
  explicit Writer(std::filesystem::path folder) : folder_(std::move(folder)) {}

  template <typename T>
  void operator()(const std::string& name, const std::vector<T>& values, const std::vector<std::size_t>& shape) const {
    const std::filesystem::path path = folder_ / (name + ".npy");
    std::ofstream file(path, std::ios::binary);
    file << npy_header(type_code<T>(), shape);
    file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
    if (!file.flush()) throw std::invalid_argument("cannot write " + path.string());
  }
  template <typename T>
  void operator()(const std::string& name, const std::vector<T>& values) const {
    (*this)(name, values, {values.size()});
  }

 private:
  std::filesystem::path folder_;
};

void append(std::vector<double>& values, const Vector3& v) { values.insert(values.end(), {v.x(), v.y(), v.z()}); }

void append(std::vector<double>& values, const Control& c) { values.insert(values.end(), {c.x, c.y, c.turn, c.jump}); }

void dump_skeleton(const Skeleton& skeleton, const Writer& write) {
  const std::size_t bones = skeleton.names.size();
  std::vector<double> offsets, tips;
  for (std::size_t b = 0; b < bones; ++b) {
    append(offsets, skeleton.offsets[b]);
    append(tips, skeleton.tips[b]);
  }
  write("parents", skeleton.parents);
  write("offsets", offsets, {bones, 3});
  write("tips", tips, {bones, 3});
  write("measured", measured_bones(skeleton));
  write("hips", std::vector<int>{skeleton.roles.hips});
  write("scale", std::vector<double>{standard_scale(skeleton)});
}

// The clips behind one another; a fragment's range is in frames of the whole.
void dump_motion(const PackedPool& pool, const Writer& write) {
  std::vector<double> roots, rotations, headings, evident;
  std::vector<int> starts, ranges, played;
  for (const PackedClip& packed : pool.clips) {
    const Clip clip = unpack(packed);
    starts.push_back(static_cast<int>(headings.size()));
    roots.insert(roots.end(), clip.root_positions.begin(), clip.root_positions.end());
    rotations.insert(rotations.end(), clip.rotations.begin(), clip.rotations.end());
    headings.insert(headings.end(), clip.headings.begin(), clip.headings.end());
  }
  for (const Fragment& fragment : pool.fragments) {
    const int start = starts[fragment.clip];
    ranges.insert(ranges.end(), {start + fragment.begin, start + fragment.end});
    played.insert(played.end(), {start + fragment.first_played(), start + fragment.last_played()});
    append(evident, fragment.evident);
  }
  const std::size_t frames = headings.size(), bones = pool.skeleton.names.size(), count = pool.fragments.size();
  write("root_positions", roots, {frames, 3});
  write("rotations", rotations, {frames, bones, 4});
  write("headings", headings);
  write("ranges", ranges, {count, 2});
  write("played", played, {count, 2});
  write("evident", evident, {count, 4});
}

void dump_controls(const ControlSpace& space, const std::vector<int>& trace, const Writer& write) {
  std::vector<double> points;
  for (int c = 0; c < kPaperPoints; ++c) append(points, space.point(c));
  const ControlWeights& weights = space.weights();
  write("points", points, {kPaperPoints, 4});
  write("control_weights", std::vector<double>{weights.velocity * space.scale(), weights.turn, weights.jump});
  write("trace", trace);
}

void dump_results(const Workload& w, const Writer& write) {
  const auto n = static_cast<std::size_t>(w.classes.count),
             stride = static_cast<std::size_t>(w.trajectories.whole.stride());
  const SvmPolicy svm = svm_policy(w.quality, {w.controls}, w.features, w.built->space);
  write("trajectories", w.trajectories.whole.values(), {kFragments, 3, stride});
  write("labels", w.classes.labels);
  write("representatives", w.classes.representatives);
  write("restarts", std::vector<int>{clustering().restarts});
  write("inertia", std::vector<double>{w.classes.inertia});
  write("smoothness", w.quality.smoothness, {n, n});
  write("match", w.quality.match, {n, kPaperPoints});
  write("optimal", std::vector<double>{optimal_path(w.quality, w.controls).quality});
  write("features", w.features, {n, w.features.size() / n});
  write("svm_table", svm.policy.next, {n, kPaperPoints});
  write("iterate_table", iterate_policy(w.quality, {w.controls}).next, {n, kPaperPoints});
}

}  // namespace

void dump(const Workload& w, const std::filesystem::path& folder) {
  const Writer write(folder);
  dump_skeleton(w.pool.skeleton, write);
  dump_motion(w.pool, write);
  dump_controls(w.built->space, w.controls, write);
  dump_results(w, write);
}

}  // namespace fragmotion::benchmarks
