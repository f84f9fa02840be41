// Truchet's tiles, golfed: macros in place of functions, chained commas, a main that is nothing else.
#define R(a) mat2(cos(a+vec4(0,11,33,0)))
#define H(p) fract(sin(dot(p,vec2(41,289)))*45758.)
void mainImage(out vec4 O,vec2 u){vec2 main=u,r=iResolution.xy,p=(u-.5*r)/r.y*6.*R(.3),i=floor(p),f=fract(p);
if(H(i)>.5)f.x=1.-f.x;float d=min(abs(length(f)-.5),abs(length(1.-f)-.5));
O=vec4(smoothstep(.16,.12,d)-smoothstep(.1,.06,d)*.5);O.gb*=vec2(.8,.5)+.2*sin(iTime+i.x),O.a=1.;}
