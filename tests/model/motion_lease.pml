/* Motion is a lease: a console, a robot with its drive gate, persons, and a network that keeps none of its promises.
 * Mirrors ControlStamper, ControlGuard (liena/src/session), RobotMachine and DriveGate (liena/devices). How a session is opened is
 * session_dialogue.pml; here a session may be lost at any moment, by either end alone. Ghosts say what happened and decide nothing. */

#ifndef LEASE
#define LEASE 1    /* ticks a command moves the drives */
#endif
#ifndef AGE
#define AGE 1      /* ticks a command may be older than the heartbeat it echoes */
#endif
#ifndef LOSSES
#define LOSSES 1   /* of a session, or stand-bys of a third device */
#endif
#ifndef ARMS
#define ARMS 2     /* times a person arms */
#endif
#ifndef COMMANDS
#define COMMANDS 2 /* motion commands composed */
#endif
#ifndef REPLAYS
#define REPLAYS 1
#endif
#define SESSIONS (LOSSES + 2)
#define TOO_OLD (AGE + 1)

#ifdef MUT_NO_EPOCH
#define EPOCH_HOLDS(e) true
#else
#define EPOCH_HOLDS(e) ((e) == epoch)
#endif
#ifdef MUT_NO_SEQUENCE
#define SEQUENCE_HOLDS(s) true
#else
#define SEQUENCE_HOLDS(s) ((s) > newest)
#endif
/* Heartbeat numbers begin again with a session, so the echo of an earlier era can look young: it counts as young here. */
#ifdef MUT_NO_AGE
#define AGE_HOLDS(a, r) true
#else
#define AGE_HOLDS(a, r) ((a) <= AGE || (r) != era)
#endif
#ifdef MUT_NO_PERMIT
#define PERMIT_HOLDS(p) true
#else
#define PERMIT_HOLDS(p) ((p) == permit)
#endif

mtype = { Open, Reconnecting, StandBy, Reopening };            /* a session */
mtype = { Hold, Ready, Armed, Engaged };                       /* the robot */
mtype = { DiagnosisHandshake, ReOpened, Arm, Neutral, Drive }; /* console to robot */
mtype = { Commit, Heartbeat };                                 /* robot to console; RobotStatus rides on the heartbeat */

#define MESSAGE mtype, byte, byte, byte, byte, byte, byte, byte /* kind, session, epoch, sequence, age of the echo, permit; ghosts: era, number */
chan queued = [1] of { MESSAGE }; /* stamped, not yet on the wire */
chan wire = [2] of { MESSAGE };   /* may lose, hold back and repeat */
chan late = [1] of { MESSAGE };   /* bytes of the connection before */
chan back = [1] of { mtype, byte, byte, byte, byte, byte }; /* kind, session, epoch, age, permit; ghost: era */

/* The robot */
mtype life = Open, state = Hold;
byte session = 1, epoch = 1, newest, permit = 1, lease;
bool moving, neutralSeen, incident; /* incident: a third device's */

/* The console */
mtype cLife = Open;
byte cSession = 1, cEpoch, cSequence, cAge, cPermit, armedFor;
byte cIncident, shown, click; /* held; on the screen; named by a person's confirmation */

byte losses = LOSSES, arms = ARMS, commands = COMMANDS, replays = REPLAYS;

/* Ghosts */
byte era = 1, cEra, number, lastNumber, lastOpened = 1, since;
bool asked[16];             /* a person armed for this permit */
bool confirmed[SESSIONS+1]; /* a person confirmed the incident that this session ends */
bool seen[SESSIONS+1];      /* a person confirmed while this incident was on the screen */
bool staleQueue;

#define CONSOLE_GONE (cSession != session || cLife == StandBy || cLife == Reopening)
#define ROBOT_GONE (cSession != session || life == StandBy)

/* Not vacuous: with one of these, the state must be found. */
#ifdef REACH_MOTION
#define UNREACHED assert(!moving)
#elif defined(REACH_MOTION_AGAIN)
#define UNREACHED assert(!(moving && session > 1))
#else
#define UNREACHED skip
#endif

#define MOTION_IS_LEASED \
  UNREACHED; \
  assert(!moving || (life == Open && !incident && state == Engaged && lease > 0)); \
  assert(!moving || since <= AGE + LEASE)

inline raiseEpoch() {
  era++;
#ifndef MUT_SAME_EPOCH
  epoch++;
#endif
  newest = 0
}

/* RobotMachine::enterHold: the gate stops and locks, a new permit, control revoked. */
inline enterHold() { state = Hold; moving = false; lease = 0; neutralSeen = false; permit++; raiseEpoch() }

inline leaveOpen() {
#ifdef MUT_LEASE_KEPT
  skip
#else
  if :: state != Hold -> enterHold() :: else -> skip fi
#endif
}

/* What the library checks last, and what it promises of everything it hands to the application. */
inline control(kind_, e, s, a, p, r, n, lawful) {
  if
  :: life == Open && EPOCH_HOLDS(e) && SEQUENCE_HOLDS(s) && AGE_HOLDS(a, r) && !incident ->
#ifndef ONLY_MOTION
       assert(r == era);         /* composed after everything that was lost or revoked was known there */
       assert(n > lastNumber);   /* once, and in order */
       assert(a <= AGE);
       assert(lawful);           /* by the device the header names */
#endif
       newest = s; lastNumber = n;
       if
       :: kind_ == Arm && state == Ready && PERMIT_HOLDS(p) ->
            assert(asked[permit]);
            state = Armed; neutralSeen = false
       :: kind_ == Neutral && (state == Armed || state == Engaged) && PERMIT_HOLDS(p) ->
            neutralSeen = true; state = Armed; moving = false; lease = 0
       :: kind_ == Drive && (state == Armed || state == Engaged) && PERMIT_HOLDS(p) && neutralSeen ->
            assert(asked[permit]);
            assert(r == era && lawful);
            state = Engaged; moving = true; lease = LEASE; since = a
       :: else -> skip
       fi
  :: else -> skip
  fi
}

active proctype Robot() {
  mtype k; byte m, e, s, a, p, r, n;
end: do
  :: atomic { (nempty(wire) || nempty(late)) ->
       if :: nempty(wire) -> wire?k,m,e,s,a,p,r,n :: nempty(late) -> late?k,m,e,s,a,p,r,n fi;
       if
       :: k == DiagnosisHandshake && m > session ->
            leaveOpen();
            if :: life == Open -> raiseEpoch() :: else -> skip fi;
            life = Reopening; session = m; newest = 0;
            if :: len(back) < 1 -> back!Commit,m,0,0,0,0 :: else -> skip fi
       :: k == ReOpened && life == Reopening && m == session ->
            raiseEpoch();
            assert(epoch > lastOpened); lastOpened = epoch;
            assert(confirmed[m]);
            life = Open
       :: k == Arm || k == Neutral || k == Drive -> control(k, e, s, a, p, r, n, true)
       :: else -> skip
       fi;
       k = 0; m = 0; e = 0; s = 0; a = 0; p = 0; r = 0; n = 0; MOTION_IS_LEASED }
  :: atomic { life != StandBy && nfull(back) -> back!Heartbeat,session,(life == Open -> epoch : 0),0,(state == Ready -> permit : 0),era }
  :: atomic { state == Hold && life == Open && !incident -> state = Ready }
  /* Lost: while losses are left, and whenever the other end has given this session up. */
  :: atomic { life == Open && (losses > 0 || CONSOLE_GONE) ->
       if :: CONSOLE_GONE -> skip :: else -> losses-- fi;
       leaveOpen(); raiseEpoch(); life = Reconnecting; MOTION_IS_LEASED }
  :: atomic { life == Reconnecting && !CONSOLE_GONE -> life = Open } /* heard again */
  :: atomic { life == Reconnecting -> raiseEpoch(); life = StandBy }
  :: atomic { life == Reopening -> life = StandBy }                                            /* 3 s */
  :: atomic { losses > 0 && !incident -> losses--; incident = true;
#ifndef MUT_LEASE_KEPT
       if :: state == Armed || state == Engaged || state == Ready -> enterHold() :: else -> skip fi;
#endif
       MOTION_IS_LEASED }
  :: atomic { incident -> incident = false }
  od
}

inline dropQueue() {
#ifdef MUT_QUEUE_KEPT
  staleQueue = staleQueue || len(queued) > 0
#else
  if :: len(queued) > 0 -> queued?_,_,_,_,_,_,_,_ :: else -> skip fi
#endif
}

inline compose(kind_, p) {
  number++; cSequence++;
  queued!kind_,cSession,cEpoch,cSequence,cAge,p,cEra,number
}

inline reopen() {
  click = 0;
  if :: len(wire) > 0 && len(late) < 1 -> wire?k,m,e,s,a,p,r,n; late!k,m,e,s,a,p,r,n :: else -> skip fi; /* the connection before */
  do :: len(wire) > 0 -> wire?_,_,_,_,_,_,_,_ :: else -> break od;
  cSession++; cLife = Reopening; cEpoch = 0; cSequence = 0; cAge = 0; cPermit = 0; cEra = 0;
  wire!DiagnosisHandshake,cSession,0,0,0,0,0,0;
  k = 0; m = 0; e = 0; s = 0; a = 0; p = 0; r = 0; n = 0
}

active proctype Console() {
  mtype k; byte m, e, s, a, p, r, n;
end: do
  :: atomic { nempty(back) -> back?k,m,e,a,p,r;
       if
       :: k == Commit && cLife == Reopening && m == cSession && len(wire) < 2 ->
            wire!ReOpened,cSession,0,0,0,0,0,0; cLife = Open; cIncident = 0
       :: k == Heartbeat && m == cSession && (cLife == Open || cLife == Reconnecting) && e != 0 ->
            if :: e != cEpoch -> cEpoch = e; cSequence = 0 :: else -> skip fi;
            cAge = a; cEra = r;
#ifdef MUT_AUTO_ARM
            if :: p != 0 && p != armedFor && arms > 0 && len(queued) == 0 -> arms--; armedFor = p; compose(Arm, p) :: else -> skip fi;
#endif
            if :: p != 0 -> cPermit = p :: else -> skip fi;
            cLife = Open
       :: else -> skip
       fi;
       k = 0; m = 0; e = 0; a = 0; p = 0; r = 0 }
  :: atomic { cLife == Open && commands > 0 && cEpoch != 0 && armedFor != 0 && empty(queued) ->
       commands--; if :: compose(Neutral, armedFor) :: compose(Drive, armedFor) fi }
  :: atomic { cLife == Open && nempty(queued) && nfull(wire) -> assert(!staleQueue); queued?k,m,e,s,a,p,r,n; wire!k,m,e,s,a,p,r,n;
       k = 0; m = 0; e = 0; s = 0; a = 0; p = 0; r = 0; n = 0 }
  :: atomic { cLife == Open && (losses > 0 || ROBOT_GONE) ->
       if :: ROBOT_GONE -> skip :: else -> losses-- fi;
       dropQueue(); armedFor = 0; cLife = Reconnecting }
  :: atomic { cLife == Reconnecting -> cLife = StandBy; cIncident = cSession }
  :: atomic { cLife == Reopening -> cLife = StandBy }
  :: atomic { shown != cIncident -> shown = cIncident } /* the screen follows */
#ifdef MUT_AUTO_RESUME
  :: atomic { cLife == StandBy && cSession < SESSIONS -> reopen() }
#else
  :: atomic { cLife == StandBy && click != 0 && cSession < SESSIONS ->
       if
#ifndef MUT_CONFIRM_UNBOUND
       :: click != cIncident -> click = 0
#endif
       :: else -> assert(seen[cIncident]); confirmed[cSession + 1] = true; reopen()
       fi }
#endif
  od
}

/* Presses when the screen asks, now or too late, once or twice; arms for the permit that is shown. */
active proctype Person() {
end: do
  :: atomic { shown != 0 && click == 0 -> click = shown; seen[shown] = true }
  :: atomic { arms > 0 && cLife == Open && cPermit != 0 && cEpoch != 0 && armedFor != cPermit && empty(queued) ->
       arms--; armedFor = cPermit; asked[cPermit] = true; compose(Arm, cPermit) }
  od
}

/* Loses and repeats what was sent; another device of the system, with its own certificate, sends in the cockpit's name. */
active proctype Network() {
  mtype k; byte m, e, s, a, p, r, n;
end: do
  :: atomic { nempty(wire) -> wire?_,_,_,_,_,_,_,_ }
  :: atomic { nempty(back) -> back?_,_,_,_,_,_ }
  :: atomic { replays > 0 && nempty(wire) && nfull(wire) -> replays--; wire?<k,m,e,s,a,p,r,n>; wire!k,m,e,s,a,p,r,n;
       k = 0; m = 0; e = 0; s = 0; a = 0; p = 0; r = 0; n = 0 }
#ifdef MUT_NO_IDENTITY
  :: atomic { state == Armed || state == Engaged -> control(Drive, epoch, newest + 1, 0, permit, era, lastNumber + 1, false); MOTION_IS_LEASED }
#endif
  od
}

inline grow(q) {
  i = len(q);
  do
  :: i > 0 -> q?k,m,e,s,a,p,r,n; a = (a < TOO_OLD -> a + 1 : a); q!k,m,e,s,a,p,r,n; i--
  :: else -> break
  od
}

active proctype Time() {
  mtype k; byte m, e, s, a, p, r, n, i;
end: do
  :: d_step { true ->
       grow(queued); grow(wire); grow(late);
       if :: len(back) > 0 -> back?k,m,e,a,p,r; a = (a < TOO_OLD -> a + 1 : a); back!k,m,e,a,p,r :: else -> skip fi;
       cAge = (cEpoch != 0 && cAge < TOO_OLD -> cAge + 1 : cAge);
       k = 0; m = 0; e = 0; s = 0; a = 0; p = 0; r = 0; n = 0;
       if :: moving -> since++; lease--; if :: lease == 0 -> since = 0; enterHold() :: else -> skip fi :: else -> since = 0 fi;
       MOTION_IS_LEASED }
  od
}
