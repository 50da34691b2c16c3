"""What may be raised across floors. Anything else that escapes is our own bug (exit status 4)."""


class UsageError(Exception):
    """The command line asks for something that does not exist: one sentence and a hint."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.hint = message, hint


class NumericsError(Exception):
    """A computation that cannot be trusted; the engine turns it into a NUM finding and an undecided verdict.

    `spent` is the seconds that it came to by what was counted, where that can be more than what was predicted.
    """

    def __init__(self, code: str, message: str, spent: float = 0.0) -> None:
        super().__init__(message)
        self.code, self.message, self.spent = code, message, spent
