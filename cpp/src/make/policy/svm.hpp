// SPDX-License-Identifier: MIT
#pragma once

#include "base/progress.hpp"
#include "classes/classes.hpp"
#include "fragments/distance.hpp"
#include "policy/policy.hpp"
#include "policy/quality.hpp"

namespace fragmotion {

/// What the SVM is trained on: x = (features of the previous class, control), y = the next class (Sec. 3.3).
struct SvmSamples {
  int width = 0;
  std::vector<double> inputs;  ///< [samples, width]
  std::vector<int> labels;     ///< [samples]
};

struct SvmOptions {
  double c = 0;      ///< Penalty a of Eq. 5, 1e-6 .. 1e6; 0: by cross-validation.
  double gamma = 0;  ///< Of Eq. 6, 1e-6 .. 1e6; 0: by cross-validation.
  int threads = 0;   ///< 0 or less: as many as the machine has.
};

/// A trained policy with the parameters that made it.
struct SvmPolicy {
  Policy policy;
  double c = 0;
  double gamma = 0;
  double accuracy = 0;  ///< Of the cross-validation, 0..1; 0 where C and gamma were given.
};

/// The features of each class as a previous class, [classes, up to 8]: the principal components of its representative's
/// last pose, which is all that Eq. 2 sees of it, in units of the first component's standard deviation.
std::vector<double> class_features(const Trajectories& t, const Classes& classes);

/// The samples that Optimal's path over the traces gives: (Q_i, c_i) -> Q_{i+1}. Throws std::invalid_argument unless
/// every class has as many features, at least one.
SvmSamples svm_samples(const Quality& quality, const std::vector<std::vector<int>>& traces,
                       const std::vector<double>& features, const ControlSpace& space);

/// C-SVC with the RBF kernel (Eqs. 5 and 6, libsvm), one against one, asked for every class and control. Throws
/// std::invalid_argument without a trace, and on C or gamma out of range.
SvmPolicy svm_policy(const Quality& quality, const std::vector<std::vector<int>>& traces,
                     const std::vector<double>& features, const ControlSpace& space, const SvmOptions& options = {},
                     const Progress& progress = {});

}  // namespace fragmotion
