// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/log_notes.hpp"

#include <algorithm>

namespace polargrain::app {
namespace {

struct KindOfNote {
  const char* part;  ///< of the text
  NoteWeight weight;
  const char* meaning;
};

/// The notes come from run.cpp, run_observer.cpp, materials and workers.
constexpr KindOfNote kKinds[] = {
    {"within the noise of the stresses", NoteWeight::look,
     "The step is as well balanced as the noise of the cells' stresses lets it be, but not to the tolerance asked for. Results "
     "are good to that noise (force_noise in history.csv). To get below it: a smaller unbalanced_force_ratio of the material, "
     "or more grains."},
    {"nothing but rounding is left", NoteWeight::usual,
     "The step is balanced to the last digits of its numbers, and steps: tolerance asks for more. Harmless; give a larger "
     "tolerance to avoid it."},
    {"asked for strains beyond", NoteWeight::usual,
     "The correction asked for a larger strain than steps: largest_strain allows, and was shortened. Usual at a peak. If it "
     "happens in every step, make the steps smaller."},
    {"jumps of the stresses were passed", NoteWeight::look,
     "Grains rearranged however small the step was made, and steps: jumps let the run go on; the step ended in balance. Each "
     "one is a place where the path is not the only possible one. Cells with more grains jump less."},
    {"moduli of the packing at rest", NoteWeight::usual,
     "The moduli and limits that the cells of this region take from their packing."},
    {"given up:", NoteWeight::usual,
     "A step found no balance and was tried again, smaller. Usual at a peak. Where many steps are cut: a larger count of steps, "
     "acceleration: 5 where the tangent is not true, or a tolerance above force_noise (history.csv)."},
    {"may hold false answers", NoteWeight::serious,
     "Two workers gave different answers to the same question; see polargrain verify and docs/trust.md."},
    {"this result cannot be verified", NoteWeight::look,
     "The sample of answers could not be written; the result itself is whole."},
    {"checkpoint was written by version", NoteWeight::look,
     "The run was begun with another version of the program."},
    {"cannot be interrupted without loss", NoteWeight::usual,
     "A material of this case cannot be kept in a checkpoint."},
    {"with one worker no evaluation can be checked", NoteWeight::usual,
     "workers: check needs two workers or more."},
    {"did not converge", NoteWeight::serious,
     "The run ended here. All steps that were committed before are good. The last lines of the log list the attempts. Frequent "
     "causes are a body without balance at this load, steps that are too large, and a tolerance below the noise."},
    {"points at the end (in any step)", NoteWeight::look,
     "Grains bear skew and couple stress only in proportion to their pressure, and bear nothing where they have parted. The stress of "
     "these points is at that limit (fields skew_mobilisation, couple_mobilisation, parted). Usual in shear bands and behind "
     "plates. Where many points have parted, ask whether the ground would be in tension there."},
    {"small deformation", NoteWeight::serious,
     "Rotations or strains have grown beyond the range of small deformation; deformation: large takes them into account."},
};

std::string kind_of(const std::string& text) {
  for (const KindOfNote& kind : kKinds)
    if (text.find(kind.part) != std::string::npos) return kind.part;
  // Texts that differ in their numbers only are of one kind.
  std::string without_numbers;
  for (const char c : text)
    if (std::string_view("0123456789.+-").find(c) == std::string_view::npos) without_numbers += c;
  return without_numbers;
}

}  // namespace

std::string name_of(NoteWeight weight) {
  switch (weight) {
    case NoteWeight::serious:
      return "serious";
    case NoteWeight::look:
      return "look";
    case NoteWeight::usual:
      break;
  }
  return "usual";
}

std::vector<LogNote> notes_of(const std::vector<LoggedWarning>& warnings) {
  std::vector<LogNote> notes;
  std::vector<std::string> kinds;
  for (const LoggedWarning& warning : warnings) {
    const std::string kind = kind_of(warning.text);
    const auto place = static_cast<std::size_t>(std::ranges::find(kinds, kind) - kinds.begin());
    if (place == kinds.size()) {
      const auto* const known = std::ranges::find(kKinds, kind, &KindOfNote::part);
      notes.push_back({warning.text, 0, warning.step, warning.step,
                       known == std::end(kKinds) ? NoteWeight::look : known->weight,
                       known == std::end(kKinds) ? "" : known->meaning});
      kinds.push_back(kind);
    }
    LogNote& note = notes[place];
    ++note.count;
    note.last_step = warning.step;
  }
  return notes;
}

}  // namespace polargrain::app
