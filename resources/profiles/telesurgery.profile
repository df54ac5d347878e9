# Telesurgery in general, for robots whose message sets allow commands of such an age (max-age). The limits for delay are those of
# surgeons' performance and not of a device: look at vascular-robot for those of the reference robot.
title    Telesurgery over a distance
commands 500 /s
frames   30 /s
image    256 KiB    # a compressed picture of an endoscope or of fluoroscopy

# Xu, Perez, Yang, Perrenot, Felblinger, Hubert: Determination of the latency effects on surgical performance and the acceptable
# latency levels in telesurgery using the dV-Trainer simulator, Surgical Endoscopy 28 (2014) 2569-2576: up to 200 ms is ideal, 300 ms is
# suitable, 400 to 500 ms tires. These are from the hand to the eye. Half of each is left to robot, camera, codec and screen.
round-trip-p99               100 ms   150 ms
round-trip-beside-images-p99 100 ms   150 ms
image-delivery-p99           100 ms   150 ms

# Of the rare late ones half of 300 and of 500 ms. That one in a thousand may be later, one every two seconds at 500 a second, is our own
# judgement.
round-trip-beside-images-p99.9 150 ms 250 ms

# ITU-T Y.1541 (12/2011), table 1, classes 0 and 1 (also in RFC 5976): variation of the delay at most 50 ms at the 99.9th percentile, loss at most
# 1 in 1000. The same for both ways together is stricter, and half of it is good; 1 % is our own judgement.
jitter                       25 ms    50 ms
jitter-beside-images         25 ms    50 ms
loss                         0.1 %    1 %

# A command is withheld at its source when a thousand are still under way: the line does not carry their rate. Our own judgement.
commands-carried             99.9 %   99 %

# 30 frames of 256 KiB a second are 7.9 MB/s; that a quarter of the line should stay free is our own judgement.
image-rate                   10.5 MB/s  7.9 MB/s
images-carried               99 %     95 %
