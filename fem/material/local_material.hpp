// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <concepts>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/packed_values.hpp"
#include "fem/material/material.hpp"
#include "fem/material/rotation.hpp"
#include "fem/material/strain_driven.hpp"

namespace polargrain::fem {

/// A constitutive law that answers for one point in place, from a plain state and an increment. A law holds
/// parameters only; the values that change at a point live in its State.
///
///     struct Law {
///       static constexpr int dimension = 3;         // 2 where it is not said
///       struct State { ... };                       // copyable, plain data
///       State initial_state() const;
///       Response<dim> integrate(const State& start, const Increment<dim>& increment, State& trial) const;
///     };
///
/// integrate must not throw for an increment it cannot follow: it returns Quality::failed with a message.
/// A law may also have
///
///       State initial_state(const Vector& stress) const;          // Cosserat<dim>::Vector
///       State rotated(const State& state, const Turn<dim>& turn) const;
///       static std::vector<std::string> field_names();
///       void fields(const State& state, std::span<double> values) const;
///       Response<2> integrate(const State& start, const Vector7& strain, State& trial) const;  // any eps_33
///       static std::vector<double> packed(const State& state);         // always as many values,
///       static State unpacked(std::span<const double> values);         // and back: for checkpoints
template <class Law>
inline constexpr int dimension_of = 2;
template <class Law>
requires requires {
  Law::dimension;
}
inline constexpr int dimension_of<Law> = Law::dimension;

template <class Law>
using StressOf = typename Cosserat<dimension_of<Law>>::Vector;

template <class Law>
concept LocalLaw = requires(const Law law, const typename Law::State start,
                            const Increment<dimension_of<Law>> increment, typename Law::State trial) {
  { law.initial_state() } -> std::same_as<typename Law::State>;
  { law.integrate(start, increment, trial) } -> std::same_as<Response<dimension_of<Law>>>;
};

/// The law can start from any stress: State initial_state(const Vector& stress) const.
template <class Law>
concept LawWithGivenStress = requires(const Law law, const StressOf<Law> stress) {
  { law.initial_state(stress) } -> std::same_as<typename Law::State>;
};

/// The law can turn the state of a point: State rotated(const State& state, const Turn<dim>& turn) const.
template <class Law>
concept LawWithRotation = requires(const Law law, const typename Law::State state) {
  { law.rotated(state, no_turn<dimension_of<Law>>()) } -> std::same_as<typename Law::State>;
};

/// The law also shows values beyond stress and strain.
template <class Law>
concept LawWithFields = requires(const Law law, const typename Law::State state, std::span<double> values) {
  { law.field_names() } -> std::same_as<std::vector<std::string>>;
  law.fields(state, values);
};

/// The law's states can be written to a checkpoint and read back, bit for bit.
template <class Law>
concept LawWithArchive = requires(const typename Law::State state, std::span<const double> values) {
  { Law::packed(state) } -> std::same_as<std::vector<double>>;
  { Law::unpacked(values) } -> std::same_as<typename Law::State>;
};

/// The law also follows strains along e_3.
template <class Law>
concept LawOfStrain = dimension_of<Law>
== 2 && requires(const Law law, const typename Law::State start, const StressOf<Law> strain,
                 typename Law::State trial) {
  { law.integrate(start, strain, trial) } -> std::same_as<Response<dimension_of<Law>>>;
};

/// Makes a Material of a local law: keeps the committed and the trial state of every point.
template <LocalLaw Law>
class LocalMaterial final : public Material<dimension_of<Law>>,
                            public std::conditional_t<dimension_of<Law> == 2, StrainDriven, NotStrainDriven> {
  static constexpr int dim = dimension_of<Law>;

 public:
  explicit LocalMaterial(Law law) : law_(std::move(law)) {}

  void allocate(std::size_t points) override {
    committed_.assign(points, law_.initial_state());
    trial_ = committed_;
  }

  void set_initial_stress(std::size_t point, const StressOf<Law>& stress) override {
    if constexpr (LawWithGivenStress<Law>) {
      committed_[point] = trial_[point] = law_.initial_state(stress);
    } else {
      Material<dim>::set_initial_stress(point, stress);
    }
  }

  [[nodiscard]] bool can_turn() const override { return LawWithRotation<Law>; }

  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override {
    for (std::size_t point = 0; point < committed_.size(); ++point) {
      const StretchAndTurn<dim> step = stretch_and_turn(increments[point]);
      responses[point] = law_.integrate(committed_[point], step.stretch, trial_[point]);
      if constexpr (LawWithRotation<Law>) {
        if (increments[point].configuration == Configuration::fixed) continue;
        trial_[point] = law_.rotated(trial_[point], step.turn);
        responses[point] = rotated(responses[point], step.turn);
      }
    }
  }

  [[nodiscard]] bool takes_any_strain() const { return LawOfStrain<Law>; }
  Response<dim> evaluate_strain(const StressOf<Law>& strain) {
    if constexpr (LawOfStrain<Law>) {
      return law_.integrate(committed_.front(), strain, trial_.front());
    } else {
      (void)strain;
      throw RunError("this material follows strains of the plane alone");
    }
  }

  void commit() override { committed_ = trial_; }
  void revert() override { trial_ = committed_; }

  void save(ArchiveWriter& archive) const override {
    if constexpr (LawWithArchive<Law>) {
      std::vector<double> values;
      for (const auto& state : committed_) {
        const std::vector<double> own = Law::packed(state);
        values.insert(values.end(), own.begin(), own.end());
      }
      archive.write("states", std::span<const double>(values));
    } else {
      Material<dim>::save(archive);
    }
  }

  void restore(ArchiveReader& archive) override {
    if constexpr (LawWithArchive<Law>) {
      const std::size_t length = Law::packed(law_.initial_state()).size();
      const std::vector<double> values = read_lists(archive, "states", committed_.size(), length);
      for (std::size_t point = 0; point < committed_.size(); ++point) {
        committed_[point] = Law::unpacked(std::span(values).subspan(point * length, length));
      }
      trial_ = committed_;
    } else {
      Material<dim>::restore(archive);
    }
  }

  /// Every number of a state is a mean of its own; the law brings a stress that it cannot have back in the next evaluation.
  TakenOver take_over(ArchiveReader& archive, std::size_t count, std::span<const PointMean> means) override {
    TakenOver taken;
    if constexpr (LawWithArchive<Law>) {
      const std::size_t length = Law::packed(law_.initial_state()).size();
      const std::vector<double> values = read_lists(archive, "states", count, length);
      for (std::size_t point = 0; point < committed_.size(); ++point) {
        std::vector<double> own(length, 0.0);
        for (std::size_t k = 0; k < length; ++k) {
          bool some_above = false;
          bool some_below = false;
          for (const auto& [other, weight] : means[point].parts) {
            const double value = values[other * length + k];
            own[k] += weight * value;
            some_above = some_above || value > 0.0;
            some_below = some_below || value < 0.0;
          }
          if ((own[k] < 0.0 && !some_below) || (own[k] > 0.0 && !some_above)) {
            own[k] = 0.0;
            ++taken.zeroed;
          }
        }
        committed_[point] = Law::unpacked(own);
      }
      trial_ = committed_;
    } else {
      Material<dim>::take_over(archive, count, means);
    }
    return taken;
  }

  [[nodiscard]] std::vector<std::string> field_names() const override {
    if constexpr (LawWithFields<Law>) {
      return law_.field_names();
    } else {
      return {};
    }
  }

  void fields(std::size_t point, std::span<double> values) const override {
    if constexpr (LawWithFields<Law>) {
      law_.fields(committed_[point], values);
    } else {
      (void)point;
      (void)values;
    }
  }

  [[nodiscard]] const Law& law() const { return law_; }
  /// The committed states, one a point.
  [[nodiscard]] const std::vector<typename Law::State>& states() const { return committed_; }

 private:
  Law law_;
  std::vector<typename Law::State> committed_;
  std::vector<typename Law::State> trial_;
};

}  // namespace polargrain::fem
