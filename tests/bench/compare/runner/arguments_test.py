"""What the script refuses, and in which words; what a full disk leaves behind."""
import contextlib
import io
import pathlib
import tempfile
import unittest

from . import arguments, conditions, journal, transports


def refusal(*given):
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        try:
            arguments.parse("", pathlib.Path("build"), list(given))
        except SystemExit:
            return said.getvalue()
    return ""


class ArgumentsTest(unittest.TestCase):
    def test_words_that_nobody_knows_are_named_with_those_that_are(self):
        self.assertIn("argument --workloads: pacd is not among load, neighbour", refusal("--workloads", "roundtrip,pacd"))
        self.assertIn("argument --links: 2g is not among 1g, 400m", refusal("--links", "2g"))
        self.assertIn("argument --transports: grpc is not among liena,", refusal("--transports", "liena,grpc"))
        self.assertIn("nothing is not among", refusal("--workloads", ","))

    def test_numbers_are_above_zero(self):
        for given in ("0", "-1", "nan", "inf", "many"):
            self.assertIn(f"argument --seconds: {given} is not a number above 0", refusal(f"--seconds={given}"))
        self.assertIn("argument --rounds: 1.5 is not", refusal("--rounds", "1.5"))

    def test_words_count_once_and_in_order(self):
        chosen = arguments.parse("", pathlib.Path("build"), ["--workloads", "paced, load,paced"])
        self.assertEqual(chosen.workloads, ["paced", "load"])
        self.assertIsNone(chosen.transports)

    def test_links_that_lose_packets_or_carry_too_little_are_chosen_by_name_and_not_quickly(self):
        def links(*given):
            return arguments.parse("", pathlib.Path("build"), list(given)).links

        self.assertEqual(links("--links", "100m-20ms-loss,400m-overload"), ["100m-20ms-loss", "400m-overload"])
        self.assertLessEqual({"100m-20ms-loss", "400m-overload"}, set(links()))
        self.assertEqual(links("--quick"), ["1g", "400m"])

    def test_packets_are_measured_in_round_trips_and_where_some_are_lost(self):
        packets = next(t for t in transports.TRANSPORTS if t.key == "liena-udp")
        measured = {m.key for m in conditions.loopback_measurements(arguments.WORKLOADS) + conditions.load_measurements(conditions.LINKS)
                    if packets.suits(m)}
        self.assertEqual(measured, {"roundtrip", "paced", *(f"load/100m-20ms-loss/{rate}" for rate in conditions.FRAME_RATES)})

    def test_a_worker_thread_is_measured_where_frames_are_many_bytes(self):
        worker = next(t for t in transports.TRANSPORTS if t.key == "liena-worker")
        measured = {m.key for m in conditions.loopback_measurements(arguments.WORKLOADS) + conditions.load_measurements(conditions.LINKS)
                    + conditions.neighbour_measurements() + conditions.status_measurements(conditions.LINKS) if worker.suits(m)}
        self.assertEqual(measured, {"frames", *(f"load/1g/{rate}" for rate in conditions.FRAME_RATES)})

    def test_frames_of_a_neighbour_are_its_own_and_the_commands_are_not(self):
        for measured in conditions.neighbour_measurements():
            self.assertEqual(measured.arguments[:2], ("--frame-rate", "0"))
            self.assertEqual(measured.beside[:2], ("--frame-rate", measured.key.split("/")[-1]))

    def test_status_messages_are_a_share_of_what_the_link_carries_and_a_quarter_more(self):
        measured = conditions.status_measurements(["100m", "1g", "1g-20ms"])
        rates = {link: [int(m.key.split("/")[2]) for m in measured if m.key.startswith(f"status/{link}/")] for link in ("100m", "1g", "1g-20ms")}
        self.assertEqual(rates, {"100m": [0, 191, 381, 954], "1g": [0, 1907, 3815], "1g-20ms": []})
        self.assertTrue(all("--status" in m.arguments for m in measured))

    def test_two_streams_are_measured_where_the_link_carries_both_and_no_transport_lets_one_wait_for_the_other(self):
        measured = conditions.streams_measurements(conditions.LINKS)
        self.assertEqual({m.key.split("/")[1] for m in measured}, {"1g", "400m", "100m", "1g-20ms", "400m-20ms", "100m-20ms"})
        for m in measured:
            self.assertEqual([t.key for t in transports.TRANSPORTS if t.suits(m)], ["liena", "raw"])
        without, both = measured[:2]
        self.assertEqual(without.arguments[:2], ("--frame-rate", "0"))
        self.assertNotIn("--second-rate", without.arguments)
        self.assertEqual(both.arguments[:2] + both.arguments[-2:], ("--frame-rate", "15", "--second-rate", "14.3"))
        self.assertEqual(conditions.streams_measurements(["400m-overload", "100m-20ms-loss"]), [])

    def test_a_transport_that_was_named_and_not_built_is_missing(self):
        built = [t for t in transports.TRANSPORTS if t.key in ("liena", "raw")]
        self.assertEqual([t.key for t in arguments.chosen_transports(["raw"], built)], ["raw"])
        self.assertEqual(arguments.chosen_transports(None, built), built)
        with self.assertRaisesRegex(LookupError, "zeromq: not built"):
            arguments.chosen_transports(["raw", "zeromq"], built)
        with self.assertRaisesRegex(LookupError, "no program is built"):
            arguments.chosen_transports(None, [])

    def test_a_table_that_could_not_be_written_is_known_before(self):
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "table.md"
            arguments.try_output(table)
            self.assertFalse(table.exists())
            table.write_text("of yesterday")
            arguments.try_output(table)
            self.assertEqual(table.read_text(), "of yesterday")
            with self.assertRaises(OSError):
                arguments.try_output(table / "below")


class JournalTest(unittest.TestCase):
    def test_a_full_disk_is_told_once_and_stops_nothing(self):
        said = []
        with journal.Journal(pathlib.Path("/dev/full"), said.append) as full:
            for number in range(3):
                full.keep({"round": number})
        self.assertTrue(full.failed)
        self.assertEqual(len(said), 1)
        self.assertIn("/dev/full takes no more (No space left on device)", said[0])

    def test_lines_are_added(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "kept"
            for number in (1, 2):
                with journal.Journal(path, self.fail) as kept:
                    kept.keep({"round": number})
            self.assertEqual(path.read_text(), '{"round": 1}\n{"round": 2}\n')

    def test_a_file_that_cannot_be_made_is_an_error_at_once(self):
        with self.assertRaises(OSError):
            journal.Journal(pathlib.Path("/nonexistent/kept"), self.fail)


if __name__ == "__main__":
    unittest.main()
