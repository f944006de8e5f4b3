// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace polargrain {

/// One fault in something the user wrote.
struct Fault {
  std::string file;     ///< the user's file as they named it; empty when the fault is on the command line
  int line = 0;         ///< first line is 1; 0 when the whole file is meant
  std::string message;  ///< the fault, the value expected and the remedy

  /// "file:line: message", the form that editors and terminals understand.
  [[nodiscard]] std::string text() const;
};

/// The input is wrong: nothing has been run and nothing written. Ends the program with exit status 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);
  explicit InputError(const Fault& fault) : InputError(std::vector<Fault>{fault}) {}
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// A run that was well posed could not be carried to its end. Ends the program with exit status 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Answers of a worker that a run has used may be false: there is nothing to go on from.
class FalseResults : public RunError {
 public:
  using RunError::RunError;
};

}  // namespace polargrain
