// SPDX-License-Identifier: MIT
#include "policy/svm.hpp"

#include <svm.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "base/parallel.hpp"
#include "base/ranges.hpp"
#include "policy/optimal.hpp"

namespace fragmotion {
namespace {

constexpr int kPoseComponents = 8;
constexpr int kFolds = 3;                                       // of the cross-validation
constexpr double kLeastParameter = 1e-6, kMostParameter = 1e6;  // C and gamma: far beyond, libsvm hardly ends
constexpr int kBlock = 50;  // samples: neighbours in time are alike, so folds are made of blocks of five seconds
const std::vector<double> kCosts{1, 8, 64, 512};
const std::vector<double> kGammas{1.0 / 64, 1.0 / 16, 1.0 / 4, 1};

// Rows of doubles as libsvm wants them.
class Nodes {
 public:
  Nodes(const std::vector<double>& inputs, int width) : width_(width) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      nodes_.push_back({static_cast<int>(i) % width + 1, inputs[i]});
      if (static_cast<int>(i) % width == width - 1) nodes_.push_back({-1, 0});
    }
  }
  svm_node* row(int i) { return &nodes_[static_cast<std::size_t>(i) * (width_ + 1)]; }

 private:
  int width_;
  std::vector<svm_node> nodes_;
};

struct FreeModel {
  void operator()(svm_model* model) const { svm_free_and_destroy_model(&model); }
};

// A model, with the samples that it points into.
class Model {
 public:
  Model(Nodes& nodes, const std::vector<int>& labels, const std::vector<int>& rows, double c, double gamma) {
    for (const int row : rows) {
      x_.push_back(nodes.row(row));
      y_.push_back(labels[row]);
    }
    svm_parameter parameter{};
    parameter.svm_type = C_SVC;   // Eq. 5,
    parameter.C = c;              // its penalty a,
    parameter.kernel_type = RBF;  // and Eq. 6
    parameter.gamma = gamma;
    parameter.cache_size = 16;
    parameter.eps = 1e-3;
    parameter.shrinking = 1;
    const svm_problem problem{static_cast<int>(x_.size()), y_.data(), x_.data()};
    model_.reset(svm_train(&problem, &parameter));
  }
  int predict(const svm_node* x) const { return static_cast<int>(svm_predict(model_.get(), x)); }

 private:
  std::vector<svm_node*> x_;
  std::vector<double> y_;
  std::unique_ptr<svm_model, FreeModel> model_;
};

std::vector<double> input(const double* features, int width, const Control& control, const ControlSpace& space) {
  std::vector<double> x(features, features + width);
  const ControlWeights& w = space.weights();
  x.insert(x.end(), {w.velocity * space.scale() * control.x, w.velocity * space.scale() * control.y,
                     w.turn * control.turn, w.jump * control.jump});
  return x;
}

double fold_accuracy(Nodes& nodes, const std::vector<int>& labels, double c, double gamma) {
  int right = 0;
  const int count = static_cast<int>(labels.size()), block = std::clamp(count / kFolds, 1, kBlock);
  for (int fold = 0; fold < kFolds; ++fold) {
    std::vector<int> train, test;
    for (int i = 0; i < count; ++i) (i / block % kFolds == fold ? test : train).push_back(i);
    if (train.empty() || test.empty()) continue;
    const Model model(nodes, labels, train, c, gamma);
    for (const int i : test) right += model.predict(nodes.row(i)) == labels[i] ? 1 : 0;
  }
  return static_cast<double>(right) / count;
}

// Fills c, gamma and accuracy with the best pair of the grid, or of its part where one was given; on a tie the smoother
// one (lower C, then lower gamma).
void cross_validate(const SvmSamples& samples, const SvmOptions& options, SvmPolicy& result) {
  const std::vector<double> costs = options.c > 0 ? std::vector<double>{options.c} : kCosts;
  const std::vector<double> gammas = options.gamma > 0 ? std::vector<double>{options.gamma} : kGammas;
  std::vector<double> accuracy(costs.size() * gammas.size());
  parallel_for(static_cast<int>(accuracy.size()), thread_count(options.threads), [&](int begin, int end) {
    Nodes nodes(samples.inputs, samples.width);
    for (int i = begin; i < end; ++i) {
      accuracy[i] = fold_accuracy(nodes, samples.labels, costs[i / gammas.size()], gammas[i % gammas.size()]);
    }
  });
  const auto best = static_cast<std::size_t>(std::max_element(accuracy.begin(), accuracy.end()) - accuracy.begin());
  result.c = costs[best / gammas.size()];
  result.gamma = gammas[best % gammas.size()];
  result.accuracy = accuracy[best];
}

Policy whole_table(const Model& model, const std::vector<double>& features, int classes, const ControlSpace& space,
                   int threads) {
  const int width = static_cast<int>(features.size()) / classes;
  const int controls = space.size();
  Policy policy{"svm", classes, std::vector<int>(static_cast<std::size_t>(classes) * controls), controls};
  parallel_for(classes, thread_count(threads), [&](int begin, int end) {
    for (int from = begin; from < end; ++from) {
      for (int c = 0; c < controls; ++c) {
        const std::vector<double> x =
            input(&features[static_cast<std::size_t>(from) * width], width, space.point(c), space);
        Nodes node(x, static_cast<int>(x.size()));
        policy.next[static_cast<std::size_t>(from) * controls + c] = model.predict(node.row(0));
      }
    }
  });
  return policy;
}

void check(const std::vector<std::vector<int>>& traces, const SvmOptions& options) {
  if (traces.empty()) throw std::invalid_argument("the svm policy needs at least one trace to learn from");
  for (const double value : {options.c, options.gamma}) {
    if (value != 0) require_range("the svm's C and gamma (0: chosen)", value, kLeastParameter, kMostParameter);
  }
}

}  // namespace

// The best next class depends on the previous one only by its last pose (Eq. 2). So a class is described by the
// principal components of its representative's last pose, in units of the first one's spread: in this space near means
// "goes on alike", which a number or a one-hot code of the class would not tell.
std::vector<double> class_features(const Trajectories& t, const Classes& classes) {
  const int n = classes.count, size = 3 * t.pose_stride, components = std::min(kPoseComponents, n);
  Eigen::MatrixXd poses(n, size);
  for (int k = 0; k < n; ++k) {
    poses.row(k) = Eigen::Map<const Eigen::RowVectorXf>(t.last_pose(classes.representatives[k]), size).cast<double>();
  }
  poses.rowwise() -= poses.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(poses * poses.transpose());
  const double spread = std::sqrt(std::max(solver.eigenvalues()[n - 1] / n, 1e-12));
  std::vector<double> features;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < components; ++i) {
      const int column = n - 1 - i;
      const double length = std::sqrt(std::max(solver.eigenvalues()[column], 0.0));
      features.push_back(solver.eigenvectors()(k, column) * length / spread);
    }
  }
  return features;
}

SvmSamples svm_samples(const Quality& quality, const std::vector<std::vector<int>>& traces,
                       const std::vector<double>& features, const ControlSpace& space) {
  const int width = static_cast<int>(features.size()) / quality.classes;
  if (width < 1 || features.size() != static_cast<std::size_t>(width) * quality.classes) {
    throw std::invalid_argument("every class needs as many features, at least one");
  }
  SvmSamples samples;
  for (const std::vector<int>& trace : traces) {
    const OptimalPath path = optimal_path(quality, trace);
    for (std::size_t i = 0; i < trace.size(); ++i) {
      const std::vector<double> x =
          input(&features[static_cast<std::size_t>(path.classes[i]) * width], width, space.point(trace[i]), space);
      samples.width = static_cast<int>(x.size());
      samples.inputs.insert(samples.inputs.end(), x.begin(), x.end());
      samples.labels.push_back(path.classes[i + 1]);
    }
  }
  return samples;
}

SvmPolicy svm_policy(const Quality& quality, const std::vector<std::vector<int>>& traces,
                     const std::vector<double>& features, const ControlSpace& space, const SvmOptions& options,
                     const Progress& progress) {
  check(traces, options);
  svm_set_print_string_function([](const char*) {});
  const SvmSamples samples = svm_samples(quality, traces, features, space);
  SvmPolicy result;
  result.c = options.c;
  result.gamma = options.gamma;
  report(progress, 0, "Cross-validating the SVM");
  if (options.c == 0 || options.gamma == 0) cross_validate(samples, options, result);
  report(progress, 0.7, "Training the SVM");
  Nodes nodes(samples.inputs, samples.width);
  std::vector<int> rows(samples.labels.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<int>(i);
  const Model model(nodes, samples.labels, rows, result.c, result.gamma);
  result.policy = whole_table(model, features, quality.classes, space, options.threads);
  return result;
}

}  // namespace fragmotion
