"""Every single result in a file, a line each, as it comes."""
import json


class Journal:
    """A file that cannot be opened is an OSError at once. One that takes no more is told once and ends with the last whole line; what
    is measured goes on, since the table does not need it."""

    def __init__(self, path, complain):
        self.path = path
        self.complain = complain
        self.file = path.open("ab", buffering=0) if path else None
        self.failed = False

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.file:
            self.file.close()

    def keep(self, row):
        if not self.file or self.failed:
            return
        line = json.dumps(row).encode() + b"\n"
        whole = self.file.tell()
        try:
            written = 0
            while written < len(line):
                written += self.file.write(line[written:])
        except OSError as error:
            self.failed = True
            self.complain(f"{self.path} takes no more ({error.strerror}); the results from here on are in the table only")
            try:
                self.file.truncate(whole)
            except OSError:
                pass  # a device, which keeps nothing
