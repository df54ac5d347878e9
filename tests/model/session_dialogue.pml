/* The life of one session between two devices: open, re-open, close, and every way to lose it.
 * Mirrors SessionMachine (liena/src/session) and how its shell attaches connections (liena/src/system). Device 0 has the lower id.
 * Each device makes connections to the other; what is written on one arrives in order until it breaks, and two of one direction may be
 * on their way at once. Ghosts say what happened and decide nothing. */

#ifndef FAULTS
#define FAULTS 1 /* breaks, silent deaths, restarts, failed connects, stalls, and persons who close: altogether */
#endif
#ifndef ATTEMPTS
#define ATTEMPTS 3 /* of persons to open or re-open; without a bound in LIVE */
#endif
#define TOKENS 7
#define NONE 4

mtype = { Closed, Opening, Open, Reconnecting, StandBy, Reopening, Closing }; /* a session; Suspect is Open */
mtype = { Handshake, DiagnosisHandshake, Commit, DiagnosisCommit, Attach,     /* the first on a connection, with its Attach */
          Opened, ReOpened, Disengagement, DisengagementCommit, ChannelClosed, Rejected, End };
mtype = { Free, Fresh, Waiting, Ignored, Current, Gone };                     /* a connection, as its receiver sees it */
mtype = { Lost, Ended, Withdrawn };                                           /* how what was in hand ends */

#define STANDS_BY 1 /* reasons */
#define OTHERWISE 2

/* Connections: 0 and 1 are made by device 0, 2 and 3 by device 1. */
chan wire[4] = [5] of { mtype, byte, byte }; /* kind, token, incident or reason */
mtype role[4] = Free;
bool broken[4];                              /* its maker has not noticed yet */
bool mute[4];                                /* dead, and nobody is told */
chan courier[2] = [1] of { byte, byte };     /* to that device: a Rejected on a connection of its own; token, reason */
chan unsent[2] = [2] of { mtype, byte, byte }; /* said while no connection stood */

mtype state[2] = Closed;
bool initiator[2], diagnosis[2], committed[2], peerStandsBy[2], connecting[2], closedByPeer[2], rejectedWait[2];
byte token[2], incident[2], named[2];
byte lane[2] = NONE;     /* the connection made that stands */
byte incoming[2] = NONE; /* the peer's that was attached */
byte pending[2] = NONE;  /* a handshake while open waits for the proof of life */
byte pendingToken[2], pendingPrevious[2];
bool pendingDiagnosis[2];

byte faults = FAULTS;
#ifdef LIVE /* a person acts when nothing moves, or just after the other person did */
bool hurry;
#define MAY_ATTEMPT (hurry || AFTER_110)
#define ATTEMPTED hurry = AFTER_110
#else
byte attempts = ATTEMPTS;
#define MAY_ATTEMPT (attempts > 0)
#define ATTEMPTED attempts--
#endif

byte asked, answered, led; /* ghosts, a bit by token: a person re-opened, the peer committed, the initiator opened */

#define BIT(t) (1 << (t))
#define DIALOGUE(i) (state[i] == Opening || state[i] == Reopening)
#define LIVING(i) (state[i] == Open || state[i] == Reconnecting)
#define HEARS(i) (incoming[i] != NONE && lane[1 - i] == incoming[i] && !mute[incoming[i]] && !broken[incoming[i]] && len(wire[incoming[i]]) == 0)
#define HEALS(i) (state[i] == Reconnecting && lane[i] != NONE && HEARS(i) && LIVING(1 - i)) /* a peer in a dialogue was never opened */
#define SILENT(i) (state[i] == Open && incoming[i] != NONE && (mute[incoming[i]] || lane[1 - i] != incoming[i]) && len(wire[incoming[i]]) == 0)
#define READABLE(c) (len(wire[c]) > 0 && role[c] != Waiting) /* what an ignored one brings is thrown away */
#define UNUSED(c) (role[c] == Free && len(wire[c]) == 0 && lane[(c) / 2] != (c))
#define NOTICES(i) (lane[i] != NONE && broken[lane[i]])
#define AGREED assert(state[0] != Open || state[1] != Open || token[0] == token[1])

#ifdef MUT_HEARTBEAT_STATELESS
#define UNWELL(i) false
#else
#define UNWELL(i) (state[i] == Open && HEARS(i) && state[1 - i] != Open)
#endif
#ifdef MUT_NO_TIE_BREAK
#define LEADS(i) false
#else
#define LEADS(i) (initiator[i] && i == 0)
#endif
#ifdef LOSES_OPENED /* the one fault: the initiator's connection dies with what opens the other end on it */
#define MISFORTUNE false
#define BREAKS false
#define STRIKES(c) (state[(c) / 2] == Open && DIALOGUE(1 - (c) / 2))
#else
#define MISFORTUNE (faults > 0)
#define BREAKS true
#define STRIKES(c) true
#endif
#ifdef MUT_BLAMES_AFTER_LOSS
#define DEAF(i) (DIALOGUE(i) && rejectedWait[i] && (k == Commit || k == DiagnosisCommit || k == Opened || k == ReOpened))
#else
#define DEAF(i) (DIALOGUE(i) && rejectedWait[i])
#endif
#ifdef MUT_WITHDRAWN_ENDS
#define NAMES_THIS_LOSS(i) true
#else
#define NAMES_THIS_LOSS(i) (v == token[i])
#endif
#ifdef MUT_REATTACH_TRUSTED
#define MAY_HAVE_MISSED(i) false
#else
#define MAY_HAVE_MISSED(i) DIALOGUE(i)
#endif
#ifdef MUT_LEG_UNBOUND
#define TOKEN_HOLDS(t, mine) true
#else
#define TOKEN_HOLDS(t, mine) ((t) == (mine))
#endif

#ifdef LIVE /* time passes when nothing is on its way; a shorter timer ends before a longer one, and of two dialogues the older */
byte elder;
#define BEGINS(i) elder = (DIALOGUE(1 - i) -> 1 - i : i)
#define ELDER(i) (elder == i || !DIALOGUE(1 - i))
#define IGNORED_LONG(i, c) (role[c] == Ignored && AFTER_3000 && !DIALOGUE(i)) /* it was ignored after the dialogue began */
#define CONNECTS(i) (connecting[i] && (UNUSED(2 * i) || UNUSED(2 * i + 1)))
#define MOVES(i) (CONNECTS(i) || len(courier[i]) > 0 || NOTICES(i) || HEALS(i))
#define AFTER_110 (!READABLE(0) && !READABLE(1) && !READABLE(2) && !READABLE(3) && !MOVES(0) && !MOVES(1))
#define AFTER_200 (AFTER_110 && !SILENT(0) && !SILENT(1) && pending[0] == NONE && pending[1] == NONE)
#define AFTER_500 (AFTER_200 && !rejectedWait[0] && !rejectedWait[1])
#define AFTER_1000 (AFTER_500 && state[0] != Reconnecting && state[1] != Reconnecting && !UNWELL(0) && !UNWELL(1))
#define AFTER_3000 (AFTER_1000 && state[0] != Closing && state[1] != Closing && role[0] != Fresh && role[1] != Fresh && role[2] != Fresh && role[3] != Fresh)
#else       /* a timer may end whenever it runs */
#define BEGINS(i) skip
#define ELDER(i) true
#define IGNORED_LONG(i, c) (role[c] == Ignored)
#define AFTER_110 true
#define AFTER_200 true
#define AFTER_500 true
#define AFTER_1000 true
#define AFTER_3000 true
#endif

inline forgetPending() { pending[i] = NONE; pendingToken[i] = 0; pendingPrevious[i] = 0; pendingDiagnosis[i] = false }

inline say(kind, token_, value_) { sk = kind; st = token_; sv = value_ }

inline violation() {
  assert(false); /* both devices keep the rules: neither may ever find the other at fault */
  say(Rejected, token[i], OTHERWISE);
  if :: LIVING(i) -> outcome = Lost :: else -> outcome = Ended fi
}

inline turnAway(c_, token_, reason_) { ends = ends | BIT(c_); rt = token_; rr = reason_ }

/* SessionMachine::on(HandshakeHeard) */
inline handshake() {
  answerDiagnosis = (k == DiagnosisHandshake);
  if
  :: state[i] == Closed || (state[i] == StandBy && answerDiagnosis) -> answer = c
  :: state[i] == StandBy && !answerDiagnosis -> turnAway(c, t, STANDS_BY)
  :: DIALOGUE(i) && LEADS(i) -> role[c] = Ignored
  :: DIALOGUE(i) && !LEADS(i) && incident[i] != 0 && !answerDiagnosis -> turnAway(c, t, STANDS_BY)
  :: DIALOGUE(i) && !LEADS(i) && (incident[i] == 0 || answerDiagnosis) -> outcome = Withdrawn; answer = c
  :: LIVING(i) && answerDiagnosis && (NAMES_THIS_LOSS(i) || state[i] == Reconnecting) -> outcome = Lost; answer = c
  :: state[i] == Reconnecting && !answerDiagnosis -> outcome = Lost; turnAway(c, t, STANDS_BY)
  :: state[i] == Open && (!answerDiagnosis || !NAMES_THIS_LOSS(i)) -> /* it may be one that was withdrawn, and came late */
       if :: pending[i] != NONE -> turnAway(pending[i], pendingToken[i], OTHERWISE) :: else -> skip fi;
       pending[i] = c; pendingToken[i] = t; pendingPrevious[i] = v; pendingDiagnosis[i] = answerDiagnosis; role[c] = Waiting
  :: state[i] == Closing -> turnAway(c, t, OTHERWISE)
  fi
}

inline enterOpen() {
  assert(!diagnosis[i] || (asked & BIT(token[i])));  /* no re-opening without a person's command for this very attempt */
  assert(diagnosis[i] || incident[i] == 0);          /* a plain opening never leads out of stand-by */
  assert(!initiator[i] || (answered & BIT(token[i]))); /* both legs are of this attempt */
  assert(initiator[i] || (led & BIT(token[i])));
  if :: initiator[i] -> led = led | BIT(token[i]) :: else -> skip fi;
  if :: diagnosis[i] -> incident[i] = 0 :: else -> skip fi;
  peerStandsBy[i] = false; rejectedWait[i] = false; committed[i] = false; named[i] = 0; initiator[i] = false; diagnosis[i] = false;
  state[i] = Open
}

inline commit() {
  if
  :: !DIALOGUE(i) || !initiator[i] || committed[i] || diagnosis[i] != (k == DiagnosisCommit) || !TOKEN_HOLDS(t, token[i]) -> violation()
  :: else ->
       committed[i] = true;
       if :: incident[i] == 0 -> named[i] = v :: else -> skip fi;
       if
       :: !diagnosis[i] -> say(Opened, token[i], 0)
       :: diagnosis[i] && incident[i] != 0 -> say(ReOpened, token[i], incident[i])
       :: diagnosis[i] && incident[i] == 0 -> say(ReOpened, token[i], named[i])
       fi;
       opens = true
  fi
}

inline opened() {
  if
  :: diagnosis[i] == (k == ReOpened) && DIALOGUE(i) && !initiator[i] && lane[i] != NONE && t == token[i] -> opens = true
  :: else -> violation()
  fi
}

inline laneLost() {
  if
  :: DIALOGUE(i) -> rejectedWait[i] = true
  :: state[i] == Open -> reconnect = true
  :: state[i] == Closing -> outcome = Ended
  :: else -> skip
  fi
}

inline rejected() {
  if
  :: DIALOGUE(i) && t == token[i] -> peerStandsBy[i] = (v == STANDS_BY); outcome = Ended
  :: LIVING(i) -> outcome = Lost
  :: state[i] == Closing -> outcome = Ended
  :: else -> skip
  fi
}

inline message() {
  if
  :: DEAF(i) && k != Rejected -> skip /* a lane is gone: only why matters still */
  :: !DEAF(i) && (k == Commit || k == DiagnosisCommit) -> commit()
  :: !DEAF(i) && (k == Opened || k == ReOpened) -> opened()
  :: k == Disengagement && (LIVING(i) || state[i] == Closing) && t == token[i] ->
       if :: state[i] != Closing -> closedByPeer[i] = true; state[i] = Closing :: else -> skip fi;
       say(DisengagementCommit, token[i], 0)
  :: k == DisengagementCommit && state[i] == Closing && t == token[i] ->
       if :: closedByPeer[i] -> skip :: else -> say(ChannelClosed, token[i], 0); outcome = Ended fi
  :: k == ChannelClosed && state[i] == Closing && t == token[i] -> outcome = Ended
  :: k == Rejected -> rejected()
  :: k == Attach -> skip
  :: else -> violation()
  fi
}

/* One thing read from connection c. */
inline read() {
  wire[c]?k,t,v;
  if
  :: k == End && role[c] == Current -> incoming[i] = NONE; role[c] = Free; laneLost()
  :: k == End && role[c] != Current -> role[c] = Free
  :: k != End && role[c] == Free ->
       if
       :: state[i] != Closed && state[i] != StandBy && TOKEN_HOLDS(t, token[i]) ->
            if
            :: incoming[i] != NONE -> ends = ends | BIT(incoming[i]); if :: MAY_HAVE_MISSED(i) -> rejectedWait[i] = true :: else -> skip fi
            :: else -> skip
            fi; /* in a dialogue, what opens the channel may have been lost with the one before */
            incoming[i] = c; role[c] = Current
       :: else ->
            role[c] = Fresh;
            if
            :: k == Handshake || k == DiagnosisHandshake -> handshake()
            :: k == Attach -> skip
            :: else -> ends = ends | BIT(c)
            fi
       fi
  :: k != End && role[c] == Fresh -> ends = ends | BIT(c)
  :: else -> skip
  fi;
  if :: k != End && role[c] == Current -> message() :: else -> skip fi;
  if :: opens -> enterOpen() :: else -> skip fi
}

/* The smallest token that nothing remembers and nothing on its way carries. */
inline freshToken() {
  m = BIT(token[0]) | BIT(token[1]) | BIT(incident[0]) | BIT(incident[1]) | BIT(named[0]) | BIT(named[1]) | BIT(pendingToken[0]) | BIT(pendingToken[1]) |
      BIT(pendingPrevious[0]) | BIT(pendingPrevious[1]);
  for (x : 0 .. 3) {
    n = len(wire[x]);
    do
    :: n > 0 -> wire[x]?k,t,v; m = m | BIT(t); if :: k != Rejected -> m = m | BIT(v) :: else -> skip fi; wire[x]!k,t,v; n--
    :: else -> break
    od
  }
  for (x : 0 .. 1) {
    if :: len(courier[x]) > 0 -> courier[x]?t,v; m = m | BIT(t); courier[x]!t,v :: else -> skip fi;
    n = len(unsent[x]);
    do :: n > 0 -> unsent[x]?k,t,v; m = m | BIT(t); unsent[x]!k,t,v; n-- :: else -> break od
  }
  asked = asked & m; answered = answered & m; led = led & m;
  t = 1;
  do :: m & BIT(t) -> t++ :: else -> break od;
  assert(t <= TOKENS);
  m = 0; n = 0; x = 0; k = 0; v = 0
}

inline initiate() {
  d_step {
    freshToken();
    BEGINS(i);
    initiator[i] = true; token[i] = t; connecting[i] = true;
    diagnosis[i] = (state[i] == StandBy);
    state[i] = (state[i] == StandBy -> Reopening : Opening)
  }
}

/* The connection ends at the one who made it. */
inline endLane() {
  if
  :: lane[i] != NONE ->
       x = lane[i]; lane[i] = NONE;
       if
       :: role[x] == Gone -> role[x] = Free; mute[x] = false
       :: role[x] == Free && mute[x] -> mute[x] = false
       :: role[x] != Gone && !mute[x] && !broken[x] -> wire[x]!End,0,0
       :: else -> skip
       fi;
       broken[x] = false; x = 0
  :: else -> skip
  fi
}

/* A connection stands; what it says first depends on what is in hand. */
inline connect() {
  endLane();
  connecting[i] = false; lane[i] = c;
  if
  :: DIALOGUE(i) && initiator[i] && !diagnosis[i] -> wire[c]!Handshake,token[i],0
  :: DIALOGUE(i) && initiator[i] && diagnosis[i] -> wire[c]!DiagnosisHandshake,token[i],incident[i]
  :: DIALOGUE(i) && !initiator[i] && !diagnosis[i] -> wire[c]!Commit,token[i],0; answered = answered | BIT(token[i])
  :: DIALOGUE(i) && !initiator[i] && diagnosis[i] -> wire[c]!DiagnosisCommit,token[i],incident[i]; answered = answered | BIT(token[i])
  :: else -> wire[c]!Attach,token[i],0
  fi;
  do :: len(unsent[i]) > 0 -> unsent[i]?k,t,v; wire[c]!k,t,v :: else -> break od
}

/* The process ends and begins anew; the other end is told of its connections' ends, or is not. */
inline restart() {
  if
  :: lane[i] != NONE && !mute[lane[i]] && !broken[lane[i]] && role[lane[i]] != Gone ->
       c = lane[i]; mute[c] = true;
       do :: len(wire[c]) > 0 -> wire[c]?_,_,_ :: else -> break od
  :: true -> skip
  fi;
  for (c : 2 - 2 * i .. 3 - 2 * i) {
    if :: lane[1 - i] == c && role[c] != Gone -> if :: mute[c] = true :: true -> skip fi :: else -> skip fi;
    if :: lane[1 - i] == c || role[c] != Free || len(wire[c]) > 0 -> ends = ends | BIT(c) :: else -> skip fi
  }
  forgetPending(); incident[i] = 0; peerStandsBy[i] = false;
  outcome = Ended
}

/* What every step has in common: what is said leaves first, then connections end, then what comes instead begins. */
inline conclude() {
  if
  :: sk == 0 -> skip
  :: sk != 0 && lane[i] == NONE -> if :: LIVING(i) || state[i] == Closing -> unsent[i]!sk,st,sv :: else -> skip fi
  :: sk != 0 && lane[i] != NONE -> if :: !mute[lane[i]] && !broken[lane[i]] && role[lane[i]] != Gone -> wire[lane[i]]!sk,st,sv :: else -> skip fi
  fi;
  if :: reconnect && pending[i] != NONE -> reconnect = false; outcome = Lost; unproven = true :: else -> skip fi;
  if
  :: unproven && pendingDiagnosis[i] ->
       answer = pending[i]; t = pendingToken[i]; v = pendingPrevious[i]; answerDiagnosis = true; forgetPending()
  :: else -> skip
  fi;
  if
  :: reconnect -> state[i] = Reconnecting; if :: lane[i] == NONE || silent -> connecting[i] = true :: else -> skip fi
  :: else -> skip
  fi;
  if
  :: outcome != 0 -> /* closeLanes */
       if
       :: pending[i] != NONE ->
            turnAway(pending[i], pendingToken[i], (state[i] == Closing -> OTHERWISE : STANDS_BY)); forgetPending()
       :: else -> skip
       fi;
       if :: incoming[i] != NONE -> ends = ends | BIT(incoming[i]); incoming[i] = NONE :: else -> skip fi;
       endLane();
       do :: len(unsent[i]) > 0 -> unsent[i]?_,_,_ :: else -> break od;
       if :: outcome == Lost -> incident[i] = token[i] :: else -> skip fi;
       state[i] = (incident[i] != 0 || peerStandsBy[i] -> StandBy : Closed);
       connecting[i] = false; rejectedWait[i] = false; committed[i] = false; named[i] = 0; closedByPeer[i] = false;
       initiator[i] = false; diagnosis[i] = false; token[i] = 0
  :: else -> skip
  fi;
  if
  :: answer != NONE -> /* respond */
       BEGINS(i);
       token[i] = t; named[i] = v; diagnosis[i] = answerDiagnosis; state[i] = (answerDiagnosis -> Reopening : Opening);
       incoming[i] = answer; role[answer] = Current; connecting[i] = true
  :: else -> skip
  fi;
  if :: rr != 0 && len(courier[1 - i]) == 0 -> courier[1 - i]!rt,rr :: else -> skip fi;
  x = 2 - 2 * i;
  do
  :: ends & BIT(x) ->
       ends = ends & ~BIT(x);
       do :: len(wire[x]) > 0 -> wire[x]?_,_,_ :: else -> break od;
       if
       :: lane[1 - i] == x -> role[x] = Gone; broken[x] = !mute[x]
       :: else -> role[x] = Free; mute[x] = false
       fi
  :: else -> if :: x == 3 - 2 * i -> break :: else -> x++ fi
  od;
  k = 0; t = 0; v = 0; c = 0; x = 0; sk = 0; st = 0; sv = 0; rt = 0; rr = 0; ends = 0; answer = NONE; outcome = 0;
  reconnect = false; silent = false; answerDiagnosis = false; opens = false; unproven = false;
  AGREED
}

proctype Device(byte i) {
  mtype k, sk, outcome; byte t, v, c, x, n, m, st, sv, rt, rr, ends, answer = NONE;
  bool reconnect, silent, answerDiagnosis, opens, unproven;
end: do
  :: atomic {
       if
       :: READABLE(2 - 2 * i) -> c = 2 - 2 * i; read()
       :: READABLE(3 - 2 * i) -> c = 3 - 2 * i; read()
       :: connecting[i] && (UNUSED(2 * i) || UNUSED(2 * i + 1)) -> c = (UNUSED(2 * i) -> 2 * i : 2 * i + 1); connect()
       :: NOTICES(i) -> /* OutgoingLost */
            c = lane[i]; lane[i] = NONE; broken[c] = false;
            if :: role[c] == Gone -> role[c] = Free; mute[c] = false :: else -> skip fi;
            if :: state[i] == Reconnecting -> connecting[i] = true :: else -> laneLost() fi
       :: len(courier[i]) > 0 -> courier[i]?t,v;
            if
            :: state[i] != Closed && state[i] != StandBy && t == token[i] ->
                 if :: incoming[i] != NONE -> ends = BIT(incoming[i]); incoming[i] = NONE :: else -> skip fi;
                 rejected()
            :: else -> skip
            fi
       /* Heartbeats: heard while the peer's connection stands, and they tell its state. */
       :: HEALS(i) -> state[i] = Open
       :: state[i] == Open && pending[i] != NONE && HEARS(i) && state[1 - i] == Open ->
            turnAway(pending[i], pendingToken[i], OTHERWISE); forgetPending()
       :: UNWELL(i) && AFTER_500 -> outcome = Lost
       /* Timers */
       :: SILENT(i) && AFTER_110 -> reconnect = true; silent = true
       :: state[i] == Open && pending[i] != NONE && AFTER_110 -> outcome = Lost; unproven = true
       :: rejectedWait[i] && AFTER_200 -> outcome = Ended
       :: state[i] == Reconnecting && AFTER_500 -> outcome = Lost
       :: state[i] == Closing && AFTER_1000 -> outcome = Ended
#ifndef NO_DIALOGUE_LIMIT
       :: DIALOGUE(i) && ELDER(i) && AFTER_3000 -> say(Rejected, token[i], OTHERWISE); outcome = Ended
#endif
       :: (role[2 - 2 * i] == Fresh && AFTER_1000) || IGNORED_LONG(i, 2 - 2 * i) -> ends = BIT(2 - 2 * i)
       :: (role[3 - 2 * i] == Fresh && AFTER_1000) || IGNORED_LONG(i, 3 - 2 * i) -> ends = BIT(3 - 2 * i)
       /* The person at this device */
       :: MAY_ATTEMPT && (state[i] == Closed || state[i] == StandBy) -> ATTEMPTED; initiate(); asked = asked | BIT(t)
#ifdef MUT_AUTO_RESUME
       :: state[i] == StandBy -> initiate()
#endif
       :: MISFORTUNE && DIALOGUE(i) -> faults--; say(Rejected, token[i], OTHERWISE); outcome = Ended
       :: MISFORTUNE && LIVING(i) -> faults--; state[i] = Closing; say(Disengagement, token[i], 0)
       /* What may befall it: a stall, a peer that cannot be reached, a restart */
       :: MISFORTUNE && state[i] == Open && HEARS(i) -> faults--; reconnect = true; silent = true
       :: MISFORTUNE && DIALOGUE(i) && connecting[i] -> faults--; outcome = Ended
       :: MISFORTUNE && state[i] != Closed -> faults--; restart()
       fi;
       conclude() }
  od
}

/* Breaks a connection: both ends learn of it, and a last part of what was on its way is lost. Or it dies, and nobody is told. */
proctype Network() {
  mtype k; byte t, v, c, n, keep;
end: do
  :: atomic { faults > 0 && (lane[0] != NONE || lane[1] != NONE) ->
       if :: lane[0] != NONE -> c = lane[0] :: lane[1] != NONE -> c = lane[1] fi;
       if
       :: role[c] != Gone && !broken[c] && !mute[c] && STRIKES(c) -> faults--;
            if
            :: do :: len(wire[c]) > 0 -> wire[c]?_,_,_ :: else -> break od; mute[c] = true
            :: BREAKS -> n = len(wire[c]); select(keep : 0 .. n);
               do
               :: n > 0 -> wire[c]?k,t,v; n--; if :: keep > 0 -> wire[c]!k,t,v; keep-- :: else -> skip fi
               :: else -> break
               od;
               broken[c] = true; wire[c]!End,0,0
            fi
       :: else -> skip
       fi;
       k = 0; t = 0; v = 0; c = 0; n = 0; keep = 0 }
  od
}

init { atomic { run Device(0); run Device(1); run Network() } }

#ifdef LIVE
ltl meets { []<>(state[0] == Open && state[1] == Open) }
#endif
