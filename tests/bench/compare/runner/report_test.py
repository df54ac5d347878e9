"""The table's arithmetic: medians, limits, targets and what a failed run does to them."""
import types
import unittest

from . import calm, calm_table, collapse, collapse_table, conditions, load_table, loopback_table, report, streams_table, targets, transports


def comparison(results, rounds=3):
    chosen = types.SimpleNamespace(rounds=rounds, seconds=5, real_time=False)
    return types.SimpleNamespace(results=results, transports=transports.TRANSPORTS, stalls=[0.5], states=["a1, today", "a1, today", "b2, today"], chosen=chosen)


def round_trips(*values):
    return [{"round_trip_p50": value, "round_trip_p99": 2 * value} if value else {} for value in values]


class ReportTest(unittest.TestCase):
    def test_median_leaves_failed_rounds_out(self):
        medians = report.Medians({"roundtrip": {"liena": round_trips(50, None, 70)}})
        self.assertEqual(medians.of("roundtrip", "liena", "round_trip_p50"), 60)
        self.assertIsNone(medians.of("roundtrip", "asio", "round_trip_p50"))

    def test_spread_needs_two_rounds(self):
        medians = report.Medians({"roundtrip": {"liena": round_trips(50, 75, 100), "asio": round_trips(50)}})
        self.assertAlmostEqual(medians.spread("roundtrip", "liena", "round_trip_p50"), 100 * 50 / 75)
        self.assertIsNone(medians.spread("roundtrip", "asio", "round_trip_p50"))

    def test_limit_adds_a_segment_and_the_stall(self):
        medians = report.Medians({"load/100m/0": {"liena": [{"command_p99": 100}]}})
        limits = load_table.limits_of(medians, conditions.LINKS["100m"], "load/100m/0", "liena")
        self.assertAlmostEqual(limits[0], 100 + 228.32 + 500)
        self.assertAlmostEqual(limits[1], 100 + 228.32 + 1500)

    def test_segment_is_a_quarter_of_a_millisecond_of_the_link_within_bounds(self):
        found = [conditions.Link("", megabits).segment_bytes() for megabits in (10, 100, 200, 400, 1000)]
        self.assertEqual(found, [2854, 2854, 5708, 8562, 8562])

    @staticmethod
    def beside_frames(**liena):
        own = {"command_p99": 900, "command_p999": 1500, "frame_p50": 20, "frame_count": 75, "frames_sent": 75} | liena
        others = {"raw": [{"command_p99": 18000, "frame_p50": 18}], "cyclone": [{"command_p99": 950, "frame_p50": 18}]}
        return report.Medians({"load/1g/0": {"liena": [{"command_p99": 400}]}, "load/1g/15": {"liena": [own], **others}})

    def test_load_is_judged_by_tail_peers_age_and_arrival(self):
        def answers(medians):
            return [one.met for one in targets.judged_load(medians)]

        self.assertEqual(answers(self.beside_frames()), [True] * 4)
        self.assertEqual(answers(self.beside_frames(command_p999=2100))[0], False)
        self.assertEqual(answers(self.beside_frames(command_p99=960))[:2], [True, False])
        self.assertEqual(answers(self.beside_frames(frame_p50=21))[2], False)
        self.assertEqual(answers(self.beside_frames(frame_count=70))[3], False)

    def test_it_says_how_many_lines_keep_the_limits_with_nothing_beside_the_commands(self):
        def measured(idle):
            medians = self.beside_frames()
            medians.results["load/1g/0"]["liena"] = [idle]
            return targets.judged_load(medians)[0].measured

        self.assertEqual(measured({"command_p99": 400, "command_p999": 1900}), "1; without frames 1")
        self.assertEqual(measured({"command_p99": 400, "command_p999": 2000}), "1; without frames 0")
        self.assertEqual(measured({"command_p99": 400}), "1")

    def test_commands_are_calm_when_nothing_stood_still_on_their_way_or_shortly_before(self):
        commands = [(10, 1), (20, 1), (30, 1), (40, 1)]  # due and late, ms
        self.assertEqual(calm.calm_latencies(commands, []), [1000] * 4)
        self.assertEqual(len(calm.calm_latencies(commands, [(20.2, 20.6)])), 4)  # too short
        self.assertEqual(len(calm.calm_latencies(commands, [(18, 18.6)])), 3)  # before the second, and it may still be held up
        self.assertEqual(len(calm.calm_latencies(commands, [(15, 16.9)])), 4)  # long enough before
        self.assertEqual(len(calm.calm_latencies(commands, [(20.9, 29), (28, 30.1)])), 2)
        self.assertEqual(len(calm.calm_latencies([(10, 25), (20, 1)], [(30, 31)])), 1)  # the first was under way for so long

    def test_of_few_calm_commands_nothing_is_said(self):
        self.assertEqual(calm.figures([(i, 1) for i in range(999)], []), {"calm_count": 999})
        found = calm.figures([(10 * i, 1 + i % 1000) for i in range(2000)], [(0, 2)])
        self.assertEqual(found["calm_count"], 1999)
        self.assertEqual(found["calm_max"], 1000_000)

    def test_calm_commands_are_judged_by_themselves(self):
        own = {"command_count": 2500, "calm_count": 2000, "calm_p99": 900, "calm_p999": 1500, "calm_max": 1600}
        found = {"load/1g/0": {"liena": [own | {"calm_p99": 400}]}, "load/1g/15": {"liena": [own]}}
        self.assertEqual([one.met for one in targets.judged_calm(report.Medians(found))], [True])
        self.assertEqual(len(list(calm_table.rows(report.Medians(found)))), 2)
        found["load/1g/15"]["liena"] = [own | {"calm_p999": 2100}]
        self.assertEqual([one.met for one in targets.judged_calm(report.Medians(found))], [False])
        self.assertEqual(targets.judged_calm(report.Medians({"load/1g/15": {"liena": [{"calm_count": 10, "command_count": 2500}]}})), [])

    def test_of_the_conditions_only_those_count_as_usual_where_the_link_carries_the_frames_and_loses_none(self):
        known = {f"load/{name}/{rate}": {"liena": [{"command_p99": 1}]} for name, link in conditions.LINKS.items() for rate in link.frame_rates}
        medians = report.Medians(known)
        usual = [key for key, _, _ in targets.conditions_with_frames(medians, fitting=True)]
        self.assertEqual(len(usual), 12)
        self.assertFalse([key for key in usual if "loss" in key or "overload" in key])
        self.assertEqual(list(targets.conditions_with_frames(medians, fitting=False)),
                         [("load/400m-overload/30", "load/400m-overload/0", conditions.LINKS["400m-overload"])])

    def test_commands_beside_another_sessions_frames_are_judged_by_their_own_idle_link(self):
        beside = self.beside_frames().results
        medians = report.Medians({key.replace("load", "neighbour"): found for key, found in beside.items()})
        self.assertEqual([one.met for one in targets.judged_neighbour(medians)], [True] * 4)
        self.assertEqual(targets.judged_load(medians), [])
        self.assertEqual(targets.judged_neighbour(self.beside_frames()), [])
        table = load_table.sections(medians, transports.TRANSPORTS, 5)
        self.assertEqual(len(table), 1)
        self.assertIn("beside the frames of another session, 1 Gbit/s", table[0])
        self.assertIn("two sessions", table[0])

    @staticmethod
    def beside_two_streams(**liena):
        own = {"command_p99": 900, "command_p999": 1500}
        for stream in ("frame", "second_frame"):
            own |= {f"{stream}_p50": 20000, f"{stream}_p99": 35000, f"{stream}_count": 75, f"{stream}s_sent": 75, f"{stream}s_per_second": 15}
        raw = own | {"command_p99": 9000, "frame_p50": 18000, "second_frame_p50": 18000}
        return report.Medians({"two-streams/1g/0": {"liena": [{"command_p99": 400}]}, "two-streams/1g/2": {"liena": [own | liena], "raw": [raw]}})

    def test_two_streams_are_judged_by_commands_and_by_the_later_and_rarer_of_both(self):
        def answers(**liena):
            return [one.met for one in targets.judged_streams(self.beside_two_streams(**liena))]

        self.assertEqual(answers(), [True] * 3)
        self.assertEqual(answers(command_p99=1040), [False, True, True])  # above 400 + 131 + 500
        self.assertEqual(answers(second_frame_p50=21000), [True, False, True])
        self.assertEqual(answers(second_frame_count=73), [True, True, False])
        self.assertEqual(targets.judged_load(self.beside_two_streams()), [])
        self.assertEqual(targets.judged_streams(self.beside_frames()), [])

    def test_two_streams_without_raw_tcp_have_nothing_to_be_as_old_as(self):
        medians = self.beside_two_streams()
        medians.results["two-streams/1g/2"]["raw"] = [{}]
        self.assertEqual([one.met for one in targets.judged_streams(medians)], [True] * 2)
        medians.results["two-streams/1g/2"]["liena"] = [{}]
        self.assertEqual([one.met for one in targets.judged_streams(medians)], [False] * 3)

    def test_the_table_of_two_streams_tells_both(self):
        medians = self.beside_two_streams()
        medians.results["two-streams/1g/0"]["raw"] = [{}]
        tables = list(streams_table.sections(medians, transports.TRANSPORTS, 5))
        self.assertEqual(len(tables), 1)
        self.assertIn("### Commands beside two streams of frames, 1 Gbit/s\n", tables[0])
        self.assertIn("| 968, 1 968 | yes | 20.0, 35.0 | 1.11 | 15.0 | 20.0, 35.0 | 1.11 | 15.0 |", tables[0])
        self.assertIn("| raw TCP | did not come through |", tables[0])
        self.assertEqual({line.count("|") for line in tables[0].splitlines() if line.startswith("|")}, {15})
        self.assertIn(tables[0], report.markdown(comparison(medians.results), []))

    def test_overload_is_judged_by_commands_alone(self):
        def answer(**liena):
            own = {"command_p99": 770, "command_p999": 1770, "frame_p50": 90, "frame_count": 60, "frames_sent": 150} | liena
            idle = {"command_p99": 100, "command_p999": 300}
            medians = report.Medians({"load/400m-overload/0": {"liena": [idle]}, "load/400m-overload/30": {"liena": [own]}})
            self.assertEqual(targets.judged_load(medians), [])
            return targets.judged_overload(medians)[0]

        self.assertTrue(answer().met)
        self.assertFalse(answer(command_p99=780).met)  # above 100 + 171 + 500
        self.assertFalse(answer(command_p999=1780).met)

    @staticmethod
    def with_losses(packets, **others):
        return report.Medians({"load/100m-20ms-loss/15": {
            key: [{"command_p99": p99} if p99 else {}] for key, p99 in ({"liena-udp": packets, "liena": 20} | others).items()}})

    def test_packets_are_held_against_other_transports_where_packets_are_lost(self):
        self.assertTrue(targets.judged_loss(self.with_losses(21, raw=90, cyclone=21))[0].met)
        self.assertFalse(targets.judged_loss(self.with_losses(22, raw=90, cyclone=21))[0].met)
        self.assertFalse(targets.judged_loss(self.with_losses(None, raw=90))[0].met)
        self.assertEqual(targets.judged_loss(self.with_losses(22, raw=None)), [])  # nothing to be held against
        self.assertEqual(targets.judged_load(self.with_losses(22, raw=90)), [])

    def test_those_arrived_that_came_themselves(self):
        def cells(**figures):
            found = {"command_p50": 20, "command_p99": 22, "command_p999": 22, "command_max": 23, "commands_sent": 2500} | figures
            return load_table.command_cells(found.get, 2500)[-1]

        self.assertEqual(cells(command_count=2499, commands_arrived=2470), "2 470 / 2 500 / 2 500")
        self.assertEqual(cells(command_count=2499), "2 499 / 2 500 / 2 500")  # kept by an earlier version

    def test_a_table_says_what_is_lost_or_withheld(self):
        self.assertIn("1 % of the packets are lost", load_table.what_is_no_target(conditions.LINKS["100m-20ms-loss"]))
        self.assertIn("withholds", load_table.what_is_no_target(conditions.LINKS["400m-overload"]))
        self.assertEqual(load_table.what_is_no_target(conditions.LINKS["400m"]), "")

    def test_there_are_no_limits_where_packets_are_lost(self):
        medians = report.Medians({"load/100m-20ms-loss/0": {"raw": [{"command_p99": 100}]}})
        self.assertEqual(load_table.limits_of(medians, conditions.LINKS["100m-20ms-loss"], "load/100m-20ms-loss/0", "raw"), (None, None))
        frames, status = (next(kind for kind in load_table.KINDS if kind.key == key) for key in ("load", "status"))
        self.assertNotIn("Limits:", load_table.explanation(medians, frames, "100m-20ms-loss"))
        self.assertIn("Limits:", load_table.explanation(medians, frames, "400m-overload"))
        self.assertIn("(target 1.15)", load_table.explanation(medians, frames, "400m"))
        self.assertIn("Limits:", load_table.explanation(medians, status, "400m"))
        self.assertNotIn("target 1.15", load_table.explanation(medians, status, "1g"))

    def test_status_messages_are_judged_by_the_commands_alone_also_where_they_are_too_many(self):
        def met(rate, p99, frames):
            liena = {"command_p99": p99, "command_p999": 1500, "frame_p50": 900, "frame_count": frames, "frames_sent": 1000}
            medians = report.Medians({"status/100m/0": {"liena": [{"command_p99": 100}]}, f"status/100m/{rate}": {
                "liena": [liena], "raw": [{"command_p99": 850, "frame_p50": 9}]}})
            return [one.met for one in targets.judged_status(medians)]

        few, _, many = conditions.STATUS_LINKS["100m"].frame_rates[1:]
        self.assertEqual(met(few, 820, 1000), [True, True])
        self.assertEqual(met(many, 820, 600), [True, True])
        self.assertEqual(met(few, 829, 1000), [False, True])
        self.assertEqual(met(few, 860, 1000), [False, False])

    @staticmethod
    def fallen(*rounds):
        return report.Medians({"collapse/100m": {"liena": [
            {"before_p99": 900, "during_p99": during, "during_second_p99": 5200, "after_p99": 900, "frames_during": 48, "frames_back_s": back,
             **{f"{span}_max": 9000 for span in ("before", "during", "after")}} if during else {} for during, back in rounds]}})

    def test_a_falling_link_is_judged_by_its_limit_and_by_when_frames_are_back(self):
        def answers(*rounds):
            return [one.measured for one in targets.judged_collapse(self.fallen(*rounds))]

        self.assertEqual(answers((3600, 0.8)), ["1", "1"])  # 900 + 2283 + 500
        self.assertEqual(answers((3700, 5.0)), ["0", "1"])
        self.assertEqual(answers((3600, 5.1)), ["1", "0"])
        self.assertEqual(answers((3600, float("inf"))), ["1", "0"])
        self.assertEqual(answers((None, None)), ["0", "0"])
        self.assertEqual(targets.judged_collapse(report.Medians({})), [])
        table = "\n".join(collapse_table.sections(self.fallen((4700, 5.1)), transports.TRANSPORTS))
        self.assertIn("| 900 | 4 700 | 5 200 | 900 |", table)
        self.assertIn("| 3 683 | **no** | 48 | 5.1 | **no** |", table)

    def test_the_limit_during_a_fall_begins_at_the_idle_link_where_that_was_measured(self):
        medians = self.fallen((3000, 0.8))
        medians.results["load/100m/0"] = {"liena": [{"command_p99": 200}]}
        self.assertEqual([one.measured for one in targets.judged_collapse(medians)], ["0", "1"])  # 200 + 2283 + 500

    def test_the_report_names_each_state_that_was_measured(self):
        self.assertIn("Sources: a1, today; b2, today.", report.machine(comparison({})))

    def test_a_failure_is_counted_as_not_met(self):
        medians = self.beside_frames()
        medians.results["load/1g/15"]["liena"] = [{}]
        self.assertEqual([one.measured for one in targets.judged_load(medians)], ["0"] * 4)
        self.assertIn("did not come through", "\n".join(load_table.rows(medians, load_table.KINDS[0], "1g", transports.TRANSPORTS, 5)))

    def test_what_is_missed_is_named_and_that_nothing_is_known_too(self):
        at, above = (comparison({"roundtrip": {"liena": round_trips(value), "asio-tls": round_trips(100)}}) for value in (115, 116))
        self.assertEqual(report.missed(at), [])
        self.assertEqual(report.missed(above), ["Round trip back to back, awake in dialogues ÷ Asio TLS"])
        self.assertIsNone(report.missed(comparison({"roundtrip": {"raw": round_trips(10)}})))

    def test_target_is_met_at_its_bound(self):
        at, above = (report.Medians({"roundtrip": {"liena": round_trips(value), "asio-tls": round_trips(100)}}) for value in (115, 116))
        self.assertIn("| ≤ 1.15 | 1.15 | yes |", targets.sections(at)[0])
        self.assertIn("| ≤ 1.15 | 1.16 | **no** |", targets.sections(above)[0])

    def test_what_never_sleeps_is_held_against_its_like(self):
        medians = report.Medians({"roundtrip": {"liena-spin": round_trips(26), "raw-spin": round_trips(10), "asio-tls": round_trips(50)}})
        self.assertIn("| ≤ 2.5 | 2.60 | **no** |", targets.sections(medians)[0])
        measurements = conditions.loopback_measurements(["roundtrip"])
        self.assertIn("| LiENa, TLS, never asleep | 26.0 / 52.0 (2.60) |",
                      loopback_table.sections(medians, measurements, transports.TRANSPORTS)[0])

    def test_what_sleeps_between_messages_is_held_against_asio_beside_what_stays_awake(self):
        medians = report.Medians({"roundtrip": {"liena": round_trips(20), "liena-asleep": round_trips(120), "asio-tls": round_trips(100)}})
        text = targets.sections(medians)[0]
        self.assertIn("| Round trip back to back, awake in dialogues ÷ Asio TLS | ≤ 1.15 | 0.20 | yes |", text)
        self.assertIn("| Round trip back to back, asleep between messages ÷ Asio TLS | ≤ 1.15 | 1.20 | **no** |", text)
        measurements = conditions.loopback_measurements(["roundtrip"])
        self.assertIn("| LiENa, TLS, asleep between messages | 120.0 / 240.0 (1.20) |",
                      loopback_table.sections(medians, measurements, transports.TRANSPORTS)[0])

    def test_table_names_what_did_not_come_through(self):
        results = {"roundtrip": {"liena": round_trips(50), "asio-tls": round_trips(40), "zeromq": [{}]}}
        text = report.markdown(comparison(results), conditions.loopback_measurements(["roundtrip"]))
        self.assertIn("| LiENa, TLS, awake in dialogues | 50.0 / 100.0 (1.25) |", text)
        self.assertIn("| ZeroMQ | – |", text)

    def test_frames_are_back_when_none_is_late_or_left_out_any_more(self):
        def frames(*spans):
            return [(due, late) for begin, end, period, late in spans for due in range(begin, end, period)]

        healthy, narrow = (0, 5000, 66, 20), (5000, 15000, 198, 190)
        at_once = frames(healthy, narrow, (15000, 25000, 66, 20))
        self.assertLess(collapse.frames_back(at_once, 5000, 15000), 0.2)
        late_for_a_second = frames(healthy, narrow, (15000, 16000, 66, 90), (16000, 25000, 66, 20))
        self.assertAlmostEqual(collapse.frames_back(late_for_a_second, 5000, 15000), 1.0, delta=0.2)
        left_out_in_between = frames(healthy, narrow, (15000, 17000, 66, 20), (17132, 25000, 66, 20))
        self.assertAlmostEqual(collapse.frames_back(left_out_in_between, 5000, 15000), 2.2, delta=0.2)
        self.assertEqual(collapse.frames_back(frames(healthy, narrow, (15000, 25000, 132, 20)), 5000, 15000), float("inf"))
        sometimes_late = [(due, 50 if due % 19 == 0 and not 5000 <= due < 15000 else late) for due, late in at_once]
        self.assertLess(collapse.frames_back(sometimes_late, 5000, 15000), 0.2)  # as before the collapse

    def test_spans_of_a_collapse_are_those_of_the_link(self):
        timeline = {"command_due_ms": [10, 60, 110], "command_late_ms": [1, 7, 2], "frame_due_ms": [20, 70, 120], "frame_late_ms": [5, 9, 5]}
        found = collapse.figures(timeline, 50, 100)
        self.assertEqual([found[f"{span}_p99"] for span in ("before", "during", "after")], [1000, 7000, 2000])
        self.assertEqual(found["frames_during"], 1)

    def test_the_worst_second_is_not_hidden_by_the_others(self):
        spent = [(due, 30 if 7000 <= due < 7020 else 1) for due in range(5000, 15000, 2)]  # ten of 5000 commands
        self.assertEqual(collapse.quantile([ms for _, ms in spent], 0.99), 1)
        self.assertEqual(collapse.worst_second(spent, 5000), 30000)


if __name__ == "__main__":
    unittest.main()
