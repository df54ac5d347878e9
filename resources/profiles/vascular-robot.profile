# A vascular robot as resources/devices/vascular-robot.xml declares it, with its limits for commands. Two limits each: up to the
# first the line is good, up to the second a person decides; beyond it the procedure does not begin.
title    Remote vascular intervention with the reference robot
commands 500 /s     # MotionCommand: period 2 ms
frames   15 /s      # fluoroscopy, as liena-device xray begins
image    512 KiB    # 512 x 512 pixels of 16 bits

# The robot refuses a command that is older than its max-age of 50 ms. Age counts from the heartbeat that the command echoes, and so is
# a round trip and up to one heartbeat of 20 ms: beyond 30 ms commands begin to be refused (PROTOCOL.md section 3). Caution from 25 ms.
round-trip-p99               25 ms    30 ms
round-trip-beside-images-p99 25 ms    30 ms

# Of the rare late ones: beyond 30 ms the robot may refuse a command, as it falls with the heartbeat, and beyond 50 ms it refuses each. One in
# a thousand is one every two seconds on average, at 500 a second: that no more may be later than that is our own judgement.
round-trip-beside-images-p99.9 30 ms  50 ms

# What is left of those 30 ms where the line itself takes 10 ms is 20 ms; half of it is good (our own judgement).
# The robot's commands travel as such packets, and beside its images.
jitter                       10 ms    20 ms
jitter-beside-images         10 ms    20 ms

# ITU-T Y.1541 (12/2011), table 1, classes 0 to 4 (also in RFC 5976): loss of packets at most 1 in 1000. 1 % is our own judgement: the
# control path is tested with losses up to 5 % (tests/lab), and grows slower with each.
loss                         0.1 %    1 %

# A command is withheld at its source when a thousand are still under way: the line does not carry their rate. Our own judgement.
commands-carried             99.9 %   99 %

# 15 frames of 512 KiB a second are 7.9 MB/s; that a quarter of the line should stay free is our own judgement.
image-rate                   10.5 MB/s  7.9 MB/s
images-carried               99 %     90 %

# A picture as late as the next one is due, 67 ms at 15 /s, is seen as one frame of lag; at three frames the hand runs ahead of the eye:
# Xu et al., Surgical Endoscopy 28 (2014) 2569-2576, find the delay of what is seen without effect up to 200 ms.
image-delivery-p99           67 ms    200 ms
