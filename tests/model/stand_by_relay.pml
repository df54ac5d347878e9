/* How stand-by spreads among three devices, ends, and stays ended.
 * Mirrors StandByLedger (liena/src/session): what each holds, what each remembers as ended, and what travels along the sessions.
 * Sessions are lost and re-opened as session_dialogue.pml shows; here each end of one is open or not. The number of a session is its
 * token, and that of the incident when it is lost. Ghosts decide nothing. */

#ifndef LOSSES
#define LOSSES 2   /* of sessions, altogether */
#endif
#ifndef RESTARTS
#define RESTARTS 0 /* of devices */
#endif
#ifndef DISMISSALS
#define DISMISSALS 0
#endif
#define MOST (LOSSES + 2 * RESTARTS)
#define TOKENS (3 + MOST + 1)

/* Links: 0 joins devices 0 and 1, 1 joins 0 and 2, 2 joins 1 and 2. */
#define A(l) ((l) == 2 -> 1 : 0)
#define B(l) ((l) == 0 -> 1 : 2)
#define END(l, d) (A(l) == (d) || B(l) == (d))
#define OTHER(l, d) (A(l) == (d) -> B(l) : A(l))
#define FIRST(d) ((d) == 2 -> 1 : 0)
#define SECOND(d) ((d) == 0 -> 1 : 2)
#define WAY(l, d) (2 * (l) + (A(l) == (d) -> 0 : 1)) /* what d writes on link l */

#ifdef LINE /* devices 1 and 2 have no link */
#define LINKS 2
#else
#define LINKS 3
#endif

#ifdef ONE_BREAKS
#define MAY_BREAK(l) ((l) == 0)
#else
#define MAY_BREAK(l) true
#endif

mtype = { StandBy, ReOpened, Dismissed };

chan wire[6] = [8] of { mtype, byte, byte }; /* kind, incident or new token, incident named */
byte open[6];    /* the session that this end has open */
byte mine[6];    /* the incident that this end's session machine knows */
byte due[3], dueAt[3], dueNamed[3]; bool dueAgain[3]; /* opened by the one end, not yet by the other */
#define DUE(l, d) (due[l] != 0 && dueAt[l] == (d))
byte held[3], ended[3]; /* bits by token */
byte told[3 * 8];    /* by token: the incidents that a known re-opening of that token named, as bits */
byte byToken[3 * 8]; /* the re-opening that ended an incident; 0: it was dismissed */
byte pair[8];    /* the link of a token */
byte ofLink[3];  /* the tokens of a link, as bits */
byte next = 1;
bool moving;     /* device 0 is the robot */
byte losses = LOSSES, restarts = RESTARTS, dismissals = DISMISSALS;

byte over; /* ghost: the incidents that a person ended */

#define BIT(t) (1 << (t))
#define MEMORY(d, t) ((d) * 8 + (t))

#ifdef MUT_NO_MEMORY
#define REMEMBERS(d, t) false
#else
#define REMEMBERS(d, t) (ended[d] & BIT(t))
#endif

inline tell(onLink, kind, about, naming) {
  if :: open[WAY(onLink, d)] != 0 -> wire[WAY(onLink, d)]!kind,about,naming :: else -> skip fi
}

/* To every open session but that on link `except`. */
inline broadcast(what, incident, name, except) {
  for (l : 0 .. LINKS - 1) {
    if :: l != except && END(l, d) -> tell(l, what, incident, name) :: else -> skip fi
  }
  l = 0
}

inline rememberEnded(done, cause) {
  if
  :: done != 0 && !(held[d] & BIT(done)) && !(ended[d] & BIT(done)) ->
       ended[d] = ended[d] | BIT(done); byToken[MEMORY(d, done)] = cause
  :: else -> skip
  fi
}

/* Ends every incident in `which`. */
inline endAll(by) {
  for (t : 1 .. TOKENS) {
    if
    :: which & BIT(t) ->
         assert(over & BIT(t)); /* a person re-opened that pair, or gave it up */
         held[d] = held[d] & ~BIT(t);
         rememberEnded(t, by);
         l = pair[t];
         if
         :: END(l, d) && !(held[d] & ofLink[l]) -> mine[WAY(l, d)] = 0
         :: END(l, d) && (held[d] & ofLink[l]) && mine[WAY(l, d)] == t ->
              x = 1;
              do :: held[d] & ofLink[l] & BIT(x) -> break :: else -> x++ od;
              mine[WAY(l, d)] = x; x = 0
         :: else -> skip
         fi
    :: else -> skip
    fi
  }
  t = 0; l = 0
}

/* The session with a peer ends without a word; the other end will notice in its time. */
inline lose(its) {
  x = open[WAY(its, d)];
  open[WAY(its, d)] = 0; mine[WAY(its, d)] = x;
  do :: len(wire[WAY(its, OTHER(its, d))]) > 0 -> wire[WAY(its, OTHER(its, d))]?_,_,_ :: else -> break od
}

/* StandByLedger::raise */
inline raise(fresh, notTo) {
  held[d] = held[d] | BIT(fresh);
#ifndef MUT_LEASE_KEPT
  if :: d == 0 -> moving = false :: else -> skip fi;
#endif
  broadcast(StandBy, fresh, 0, notTo)
}

inline heardStandBy() {
  if
  :: REMEMBERS(d, id) ->
       if
       :: byToken[MEMORY(d, id)] == 0 -> tell(link, Dismissed, id, 0)
       :: else -> tell(link, ReOpened, byToken[MEMORY(d, id)], id)
       fi
  :: !REMEMBERS(d, id) && (held[d] & BIT(id)) -> skip
  :: else ->
       y = pair[id];
       if
       :: END(y, d) && open[WAY(y, d)] == id -> lose(y)
       :: END(y, d) && DUE(y, d) && due[y] == id -> due[y] = 0; mine[WAY(y, d)] = id /* open and lost at the other end already */
       :: END(y, d) && !(DUE(y, d) && due[y] == id) && open[WAY(y, d)] != id && mine[WAY(y, d)] == 0 -> mine[WAY(y, d)] = id
       :: else -> skip
       fi;
       y = 0; x = 0;
#ifdef MUT_NO_RELAY
       held[d] = held[d] | BIT(id)
#else
       raise(id, link)
#endif
  fi
}

inline heardReOpened() {
  news = !(told[MEMORY(d, id)] & BIT(named)); told[MEMORY(d, id)] = told[MEMORY(d, id)] | BIT(named);
  if
  :: named != id && (news || (held[d] & BIT(named))) ->
       which = BIT(named) & held[d];
#ifdef MUT_ENDS_OLDER /* whatever of the pair seems older, by clocks that nobody set */
       if :: news -> which = which | (held[d] & ofLink[pair[id]] & ~BIT(id)) :: else -> skip fi;
#endif
       rememberEnded(named, id);
       endAll(id);
       broadcast(ReOpened, id, named, link)
  :: else -> skip
  fi;
  which = 0; news = false
}

inline heardDismissed() {
  if
  :: held[d] & BIT(id) -> which = BIT(id); endAll(0); which = 0; broadcast(Dismissed, id, 0, link)
  :: else -> skip
  fi
}

/* SessionOpened at this end: what it ended goes to all, what is held goes to the new neighbour. */
inline opened(token) {
  open[WAY(link, d)] = token; x = mine[WAY(link, d)];
  if
  :: again ->
       if :: x == 0 -> x = mine[WAY(link, OTHER(link, d))] :: else -> skip fi;
       if :: x == 0 -> x = named :: else -> skip fi;
       named = x;
       which = held[d] & ofLink[link] & ~BIT(token);
       if :: named != token && !(held[d] & BIT(named)) && (named != 0 || which == 0) -> which = which | BIT(named) :: else -> skip fi;
       told[MEMORY(d, token)] = told[MEMORY(d, token)] | which;
       rememberEnded(named, token);
       mine[WAY(link, d)] = (held[d] & BIT(token) -> token : 0);
       y = which; which = which & held[d];
       endAll(token);
       for (t : 0 .. TOKENS) { if :: y & BIT(t) -> broadcast(ReOpened, token, t, LINKS) :: else -> skip fi }
       which = 0; y = 0
  :: else -> skip
  fi;
  for (t : 1 .. TOKENS) { if :: held[d] & BIT(t) -> tell(link, StandBy, t, 0) :: else -> skip fi }
  t = 0; x = 0; named = 0
}

/* Lost at the other end, and not about to be opened there. */
#define GONE(l, d) (open[WAY(l, d)] != 0 && due[l] != open[WAY(l, d)] && open[WAY(l, OTHER(l, d))] != open[WAY(l, d)])

proctype Device(byte d) {
  mtype k; byte id, named, l, t, x, y, link, which; bool news, again;
end: do
  :: atomic {
       if :: link = FIRST(d) :: SECOND(d) < LINKS -> link = SECOND(d) fi;
       if
       :: len(wire[WAY(link, OTHER(link, d))]) > 0 && open[WAY(link, d)] != 0 ->
            wire[WAY(link, OTHER(link, d))]?k,id,named;
            if :: k == StandBy -> heardStandBy() :: k == ReOpened -> heardReOpened() :: k == Dismissed -> heardDismissed() fi
       /* Lost: at both ends, each in its time. */
       :: open[WAY(link, d)] != 0 && ((losses > 0 && MAY_BREAK(link)) || GONE(link, d)) ->
            if :: GONE(link, d) -> skip :: else -> losses-- fi;
            lose(link); /* the other end may yet read what opens it there */
            if :: held[d] & BIT(x) -> skip :: else -> y = x; raise(y, LINKS) fi
       /* A person opens or re-opens; the other end follows, or its session is lost first. */
       :: open[WAY(link, d)] == 0 && open[WAY(link, OTHER(link, d))] == 0 && next <= TOKENS ->
            again = (mine[WAY(link, d)] != 0 || mine[WAY(link, OTHER(link, d))] != 0);
            if :: again -> over = over | ofLink[link] :: else -> skip fi;
            pair[next] = link; ofLink[link] = ofLink[link] | BIT(next); due[link] = next; dueAt[link] = OTHER(link, d); next++;
            do :: len(wire[2 * link]) > 0 -> wire[2 * link]?_,_,_ :: else -> break od; /* connections of the session before */
            do :: len(wire[2 * link + 1]) > 0 -> wire[2 * link + 1]?_,_,_ :: else -> break od;
            dueAgain[link] = again; dueNamed[link] = (mine[WAY(link, d)] != 0 -> mine[WAY(link, d)] : mine[WAY(link, OTHER(link, d))]);
            opened(due[link])
       :: DUE(link, d) && open[WAY(link, OTHER(link, d))] != due[link] -> due[link] = 0 /* the attempt ends in its time */
       :: DUE(link, d) ->
            again = dueAgain[link]; named = dueNamed[link]; id = due[link]; due[link] = 0; dueAgain[link] = false; dueNamed[link] = 0;
            opened(id)
       :: dismissals > 0 && held[d] != 0 -> dismissals--;
            y = 1;
            do :: held[d] & BIT(y) -> break :: y < TOKENS -> y++ od;
            if
            :: held[d] & BIT(y) -> over = over | BIT(y); which = BIT(y); endAll(0); which = 0; broadcast(Dismissed, y, 0, LINKS)
            :: else -> skip
            fi
       :: restarts > 0 -> restarts--;
            for (y : 0 .. LINKS - 1) {
              if
              :: END(y, d) ->
                   if :: DUE(y, d) -> due[y] = 0 :: else -> skip fi;
                   lose(y); mine[WAY(y, d)] = 0
              :: else -> skip
              fi
            }
            for (y : 1 .. TOKENS) { byToken[MEMORY(d, y)] = 0 }
            for (y : 1 .. TOKENS) { told[MEMORY(d, y)] = 0 }
            held[d] = 0; ended[d] = 0; if :: d == 0 -> moving = false :: else -> skip fi
       :: d == 0 && held[0] == 0 && !moving -> moving = true
       :: else -> skip
       fi;
       k = 0; id = 0; named = 0; l = 0; t = 0; x = 0; y = 0; link = 0; which = 0; news = false; again = false;
       assert(!moving || held[0] == 0)
     }
  od
}

#define BOTH_OPEN(l) (open[2 * (l)] != 0 && open[2 * (l)] == open[2 * (l) + 1])
#define SETTLED(l) ((open[2 * (l)] == open[2 * (l) + 1]) && due[l] == 0)
#define QUIET (len(wire[0]) == 0 && len(wire[1]) == 0 && len(wire[2]) == 0 && len(wire[3]) == 0 && len(wire[4]) == 0 && len(wire[5]) == 0 && \
  SETTLED(0) && SETTLED(1) && SETTLED(2))

/* When nothing is on its way: neighbours in session hold the same incidents, and none is left once every link is open. */
active proctype Watch() {
end: do
  :: atomic { QUIET ->
       assert(!BOTH_OPEN(0) || held[0] == held[1]);
       assert(!BOTH_OPEN(1) || held[0] == held[2]);
       assert(!BOTH_OPEN(2) || held[1] == held[2]);
#ifdef LINE
       assert(!(BOTH_OPEN(0) && BOTH_OPEN(1)) || (held[0] | held[1] | held[2]) == 0)
#else
       assert(!(BOTH_OPEN(0) && BOTH_OPEN(1) && BOTH_OPEN(2)) || (held[0] | held[1] | held[2]) == 0)
#endif
     }
  od
}

init {
  atomic {
    byte l;
    for (l : 0 .. LINKS - 1) {
      open[2 * l] = next; open[2 * l + 1] = next; pair[next] = l; ofLink[l] = BIT(next); next++
    }
    run Device(0); run Device(1); run Device(2)
  }
}
