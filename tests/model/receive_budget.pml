/* The memory of a receiver: a peer with a valid certificate may announce and send any lengths; what is kept stays within the bounds.
 * Mirrors liena/src/protocol/reassembler: one partial message per number, the definition's maximum, one budget for all lanes. */

#ifndef LANES
#define LANES 2
#endif
#ifndef MAXIMUM
#define MAXIMUM 3 /* of the whole message, in units of memory */
#endif
#ifndef BUDGET
#define BUDGET 4 /* less than LANES * MAXIMUM: the lanes compete */
#endif
#define LONGEST (MAXIMUM + 2) /* that a segment can announce */

byte used;                /* what the budget has given out */
byte kept[LANES];         /* bytes of the partial message */
bool begun[LANES];        /* a partial exists */
bool discarding[LANES];   /* over budget: the rest is passed over */
bool closed[LANES];       /* a violation ended the lane */
byte memory;              /* ghost: what is really allocated */
byte delivered;           /* ghost: the length of a message that was handed on */

#define BOUNDED assert(memory <= BUDGET && used <= BUDGET && memory == used)

inline drop(l) {
  memory = memory - kept[l]; used = used - kept[l];
  kept[l] = 0; begun[l] = false; discarding[l] = false
}

inline violate(l) { drop(l); closed[l] = true }

/* The bytes of a segment that fits its message: taken from the budget first, or the message is given up. */
inline append(l, length) {
  if
  :: discarding[l] -> skip
  :: !discarding[l] && used + length <= BUDGET ->
       used = used + length; memory = memory + length; kept[l] = kept[l] + length
  :: !discarding[l] && used + length > BUDGET ->
       memory = memory - kept[l]; used = used - kept[l]; kept[l] = 0; discarding[l] = true
  fi
}

inline segment(l, length, last) {
#ifdef MUT_LIMIT_LATE
  memory = memory + length; /* room is made for what the header announces, and then the limits are looked at */
  BOUNDED;
  memory = memory - length;
#endif
  if
  :: length > MAXIMUM || kept[l] + length > MAXIMUM || (length == 0 && (begun[l] || !last)) -> violate(l)
  :: else ->
       if
       :: !begun[l] && last -> delivered = length /* whole in one segment: used where it was read */
       :: else ->
            begun[l] = true;
            append(l, length);
            BOUNDED;
            if
            :: last -> if :: discarding[l] -> skip :: else -> delivered = kept[l] fi; drop(l)
            :: else -> skip
            fi
       fi
  fi;
  BOUNDED;
  assert(delivered <= MAXIMUM && kept[l] <= MAXIMUM);
  delivered = 0
}

proctype Peer(byte l) {
  byte length; bool last;
end: do
  :: atomic { !closed[l] -> select(length : 0 .. LONGEST); if :: last = true :: last = false fi; segment(l, length, last);
       length = 0; last = false }
  :: atomic { !closed[l] && begun[l] -> drop(l); BOUNDED }  /* Abandon, or the lane was retired */
  :: atomic { closed[l] -> closed[l] = false; BOUNDED; assert(kept[l] == 0) }  /* it connects again */
  od
}

init { byte l; atomic { for (l : 0 .. LANES - 1) { run Peer(l) } } }
