// Angles followed from the sketch along straight lines of strokes, piece by piece; the rules are those of Python's `following`.
const straight=(l,r)=>{
  const w=r.t-l.t,x=r.v[0]-l.v[0],y=r.v[1]-l.v[1],size=I(Math.hypot(l.v[0],l.v[1]),Math.hypot(r.v[0],r.v[1]));
  const off=v=>Math.hypot(w*v[2]-x,w*v[3]-y);
  return Math.hypot(x,y)<=.5*size&&size>0&&(M(off(l.v),off(r.v))<=.25*size||w<=SHORT);
};
const finite=v=>v[0]-v[0]===0&&v[1]-v[1]===0;
const track=(vector,length)=>{
  const found=[];
  let l={t:0,v:vector(0)},angle=X(l.v[1],l.v[0]);
  if(angle<STRAIGHT-V/2)angle+=V;
  const piece=(l,r)=>{
    const good=straight(l,r);
    if(good||r.t-l.t<=LEAST||!finite(l.v)){
      const [a,b]=l.v,[c,e]=r.v,turn=good?X(a*e-b*c,a*c+b*e):finite(r.v)?NaN:0;
      found.push([l.t,r.t-l.t,angle,turn]);
      angle=good?angle+turn:NaN;
    }else{
      const t=.5*(l.t+r.t),m={t,v:vector(t)};
      piece(l,m);piece(m,r);
    }
  };
  for(let k=1;k<=length;k++){const r={t:k,v:vector(k)};piece(l,r);l=r;}
  return t=>{
    let low=0,high=found.length;
    while(high-low>1){const k=low+high>>1;if(found[k][0]<=t)low=k;else high=k;}
    const [begin,width,a,turn]=found[low],share=(t-begin)/width;
    return a+(share>0?share*turn:0);
  };
};
const anglesOf=(d,groups)=>{
  const vectors=followed.map(f=>f(d)),lines=[];
  // the angles along the line from the sketch by `along` a piece
  const line=(along,length)=>{
    const known=[];
    vectors.forEach((f,k)=>known.push(track(t=>{
      const p=sketch.map((s,j)=>s+along[j]*t);
      groups(p);
      known.forEach((a,j)=>p[FOLLOWED+j]=rint(a(t)));
      const v=f(p),r=[v[0],v[1],0,0];
      along.forEach((a,j)=>{r[2]+=v[2+2*j]*a;r[3]+=v[3+2*j]*a;});
      return r;
    },length)));
    return known;
  };
  return p=>{
    const q=p.slice(0,sketch.length);
    let known,t;
    if(q.length==1){
      const back=q[0]<sketch[0]?1:0,unit=units[0];
      t=A(q[0]-sketch[0])/unit;
      const length=M(1,Math.ceil(t));
      if(!lines[back]||lines[back].length<length){
        const most=M(length,Math.ceil(reach[back]/unit));
        lines[back]={length:most,known:line([back?-unit:unit],most)};
      }
      known=lines[back].known;
    }else{
      t=q.reduce((m,v,k)=>M(m,Math.ceil(A(v-sketch[k])/units[k])),1);
      known=line(q.map((v,k)=>(v-sketch[k])/t),t);
    }
    known.forEach((a,j)=>p[FOLLOWED+j]=rint(a(t)));
  };
};
const rint=a=>{const r=Math.round(a);return A(a-r)===.5&&r%2?r-1:r;};
