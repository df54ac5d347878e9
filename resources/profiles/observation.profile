# Watching, advising and tele-ultrasound without force feedback: pictures and talk, and at most slow commands.
title    Observation, advice and tele-ultrasound
commands 50 /s
frames   25 /s
image    128 KiB    # a compressed ultrasound or room picture

# ITU-T G.114 (05/2003): up to 150 ms one way most people notice nothing in a talk, up to 400 ms is the planning limit. So 300 and 800 ms
# for a round trip.
round-trip-p99               300 ms   800 ms
round-trip-beside-images-p99 300 ms   800 ms
image-delivery-p99           300 ms   800 ms

# Of the rare late ones, one in a thousand, nothing is asked: no hand is guided by these commands. Our own judgement.

# ITU-T Y.1541 (12/2011), table 1, class 1 (also in RFC 5976): variation at most 50 ms at the 99.9th percentile, loss at most 1 in 1000. TCP mends a
# loss of 1 % at the price of delay, which the limits above hold.
jitter                       50 ms    100 ms
jitter-beside-images         50 ms    100 ms
loss                         0.1 %    2 %

# A command is withheld at its source when a thousand are still under way: the line does not carry their rate. Our own judgement.
commands-carried             99 %     95 %

# 25 frames of 128 KiB a second are 3.3 MB/s; that a quarter of the line should stay free is our own judgement.
image-rate                   4.4 MB/s   3.3 MB/s
images-carried               98 %     90 %
