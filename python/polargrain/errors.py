# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors, as exceptions with the words of the program."""


class InputError(ValueError):
    """The input is wrong; no grain has moved and nothing was written.

    faults -- all of them, each as (file, line, message); the line is 0 where the whole file, or no file, is meant
    """

    def __init__(self, text, faults=()):
        super().__init__(text)
        self.faults = list(faults)


class RunError(RuntimeError):
    """A computation that was well posed could not be carried to its end."""


class StepFailed(RunError):
    """A cell could not answer to the tolerances that were asked of it; it stays where it was.

    answer      -- what it came to, with `quality` "failed" (no numbers) or "unreliable"
    step_factor -- the fraction of the increment, between 0 and 1, that should be tried instead
    """

    def __init__(self, answer):
        super().__init__(answer.message or "the cell could not answer")
        self.answer = answer
        self.step_factor = answer.step_factor

    def __reduce__(self):
        return StepFailed, (self.answer,)
